"""ROS bags, without ROS.

bounded.py    chunks are decompressed within bounds
collecting.py every message once: joint states by topic and names, and what else is of use
choosing.py   which joint states are the arm's
beside.py     commanded angles, temperatures, wrenches and tracked points, brought to the arm's times
"""
