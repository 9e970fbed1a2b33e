"""A tool calibration on one sheet of paper: HTML without scripts or outside files, made for printing on A4.

page.py       the sheet
pictures.py   the tool in its flange, the touches' distances, the tilts: SVG
"""

from app.calibration.report.page import report

__all__ = ["report"]
