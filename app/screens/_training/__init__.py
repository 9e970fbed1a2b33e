"""Parts of the training screen.

cards.py     what is said of an exercise before, while it runs, and after
plots.py     the history from try to try
scoring.py   the end of an attempt: score, kept and shown
showing.py   the demonstration of a wizard mode
"""
