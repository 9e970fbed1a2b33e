"""Tool point alone: N touches; the axes stay the flange's (ABB: TCP default orient., KUKA: XYZ 4-point)."""

from app.calibration.modes._touches import TouchMode

MODE = TouchMode("touch", "Tool point (N touches)", "default", ())
