"""Parts of the two-robot screen.

run.py      one run of the procedure in a simulated cell: what is measured, by hand or by itself
cards.py    what the panel says: the list of steps, the result
"""
