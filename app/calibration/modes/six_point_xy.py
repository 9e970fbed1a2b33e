"""Three approach points, an origin of its own, X and Y by strokes (FANUC: six point, XY)."""

from app.calibration.modes._touches import TouchMode

MODE = TouchMode("six_point_xy", "Six points (X and Y)", "xy", ("x", "y"), False, 3, 3, 3)
