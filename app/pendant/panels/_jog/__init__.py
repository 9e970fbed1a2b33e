"""Parts of the Jog tab.

user.py    the user frame: typed, or taught by three points
keys.py    the keyboard
"""
