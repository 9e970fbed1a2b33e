"""N touches and one stroke: tool point and Z; X is the flange's, made square (ABB: TCP & Z)."""

from app.calibration.modes._touches import TouchMode

MODE = TouchMode("touch_z", "Tool point and Z", "z", ("z",))
