"""What stands in the cell, one file a thing. Positions in metres, in the base frame of the arm.

ground.py      floor, light, background
cell.py        table and spike
handle.py      the drag handle at the tool point
marks.py       recorded flange poses as small frames
residuals.py   what each touch missed, as arrows
tool_axes.py   the tool frame that was found, on the tool
region.py      how well it is known: ellipsoid of its point, cones of its axes
trace.py       the way of the true tip while the tool turns about its point
next_arm.py    the arm as it would stand at the next touch, translucent
exaggeration.py  by how much small things are drawn larger
camera.py      where to look from
"""
