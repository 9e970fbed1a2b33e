"""Which groups describe a recording: the evidence decides. Knows no robot.

search.py          add, drop, swap, exchange pairs, until nothing improves: for poses and joint logs alike
change_points.py   at which row something changed: all rows at once by suffix sums
"""
