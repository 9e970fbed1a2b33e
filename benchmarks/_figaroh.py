"""FIGAROH's full geometric calibration of a position recording, as its `BaseCalibration` runs it.

Its forward kinematics (`calc_updated_fkm`), its choice of identifiable parameters and its solver call
(`least_squares`, Levenberg-Marquardt, finite differences) on the same poses and measured points.

Source: figaroh 1.0, calibration/base_calibration.py and calibration_tools.py (Apache-2.0).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import least_squares


class FigarohFit:
    """The problem set up, ready to be solved again and again.

    Args:
        model: pin's model of the robot; FIGAROH moves its joints' placements while it works.
        flange: name of the frame the reflector sits on.
        q: (m, n) joint positions [rad].
        points: (m, 3) measured [m].
        start: base x, y, z, roll, pitch, yaw in the instrument and tool x, y, z, to start from [m, rad].
    """

    def __init__(self, model: Any, flange: str, q: np.ndarray, points: np.ndarray, start: np.ndarray):
        from figaroh.calibration.calibration_tools import (
            calc_updated_fkm,
            measurement_jacobian,
            select_identifiable_parameters,
        )
        from figaroh.calibration.parameter import BASE_TPL, EE_TPL, FULL_PARAMTPL

        self._forward: Callable[..., np.ndarray] = calc_updated_fkm
        self._model = model
        self._data = self._model.createData()
        self._q, self._measured = q, points.T.reshape(-1)  # FIGAROH goes component by component
        joints = range(1, self._model.njoints)
        frames = [*BASE_TPL, *(f"{name}_1" for name in EE_TPL[:3])]
        names = [*frames, *(f"{axis}_{self._model.names[j]}" for j in joints for axis in FULL_PARAMTPL)]
        self._config: dict[str, Any] = {
            "calib_model": "full_params",
            "start_frame": "universe",
            "end_frame": flange,
            "actJoint_idx": list(joints),
            "measurability": [True] * 3 + [False] * 3,
            "calibration_index": 3,
            "NbMarkers": 1,
            "NbSample": len(q),
            "param_name": names,
        }
        first = np.concatenate([start, np.zeros(len(names) - len(frames))])
        jacobian = measurement_jacobian(self._model, self._data, first, q, self._config)
        kept, _ = select_identifiable_parameters(jacobian, names, frames)
        self._config["param_name"] = kept
        self._first = first[[names.index(name) for name in kept]]

    @property
    def size(self) -> int:
        """Number of parameters."""
        return len(self._first)

    def residual(self, values: np.ndarray) -> np.ndarray:
        """(3 m,) measured minus predicted [m]."""
        return self._measured - self._forward(self._model, self._data, values, self._q, self._config)

    def solve(self) -> float:
        """Root mean square of the residual reached [m]."""
        found = least_squares(self.residual, self._first, method="lm", max_nfev=1000)
        return float(np.sqrt(np.mean(found.fun**2)))
