"""Tool point from any number of touches, for those who want more certainty than seven give."""

from app.calibration.modes._touches import TouchMode

MODE = TouchMode("touch_many", "Tool point, any number of touches", "default", (), True, 3, 99, 10)
