"""Effects seen in joint torques over time: one file each, with the law, what is linear in it, and its words.

_law.py    what every effect of a joint log is, and the common case: a law on one joint
_load.py   a body carried by the arm
"""
