"""Calibrations on a sheet of paper: HTML without scripts or outside files, made for printing on A4.

page.py             a tool
two_robots.py       where the second robot stands for the first
pictures.py         the tool in its flange, the touches' errors, the tilts, the points of an arc: SVG
cell_picture.py     the arm and its points from the side
cell_from_above.py  both bases and the tracker
"""

from app.calibration.report.page import report
from app.calibration.report.two_robots import two_robots_report

__all__ = ["report", "two_robots_report"]
