"""What can be wrong with a set of captures: one file a check.

Each file has `CHECK` with `key` and `look(result, captures, context) -> list[Warning_]`. A check never changes the
result and never leaves a point out: it says what it saw, with the figures, and what to do next.
"""
