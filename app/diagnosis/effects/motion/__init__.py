"""Effects seen in joint torques over time: one file each, with the law and what is linear in it.

_law.py    what every effect is, and the common case: a law on one joint
_state.py  what laws are written in: motion, the description's torques, temperature
"""
