"""One file a family of actions; each has `ACTIONS`: type of action -> (state, action) -> state.

The functions are pure: they raise ActionRefusedError or give the next state, and never touch anything else.
"""
