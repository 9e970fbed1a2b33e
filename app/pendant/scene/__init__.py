"""What stands in the cell, one file a thing. Positions in metres, in the base frame of the arm.

ground.py      floor, light, background
cell.py        table and spike
handle.py      the drag handle at the tool point
marks.py       recorded flange poses as small frames
residuals.py   what each touch missed, as arrows
tool_axes.py   the tool frame that was found, on the tool
camera.py      where to look from
"""
