"""Parts of the setup screen.

user.py    the user frame: typed, or taught by three points
"""
