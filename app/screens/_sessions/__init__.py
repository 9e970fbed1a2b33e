"""Parts of the sessions screen.

replaying.py   a session's actions played again, in a state of their own
"""
