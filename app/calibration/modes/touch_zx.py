"""N touches and two strokes: the paper's full mode (ABB: TCP & Z, X)."""

from app.calibration.modes._touches import TouchMode

MODE = TouchMode("touch_zx", "Tool point and Z/X", "zx", ("x", "z"))
