"""Joint logs over time.

paths.py      trajectories that excite, with exact speed and acceleration
cell.py       what deviates, and what torque that takes
making.py     draws a motion, puts the effects in and records
writing.py    the CSV and the truth
simulate.py   one log with the effects that were asked for
"""
