"""Three approach points, an origin of its own, X and Z by strokes (FANUC: six point, XZ)."""

from app.calibration.modes._touches import TouchMode

MODE = TouchMode("six_point_xz", "Six points (X and Z)", "zx", ("x", "z"), False, 3, 3, 3)
