"""N touches, then X and Y by strokes from the last touch."""

from app.calibration.modes._touches import TouchMode

MODE = TouchMode("touch_xy", "Tool point and X/Y", "xy", ("x", "y"))
