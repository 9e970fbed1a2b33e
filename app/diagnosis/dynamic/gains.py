"""Drive gains where the header gives none: from what the description's own weight and inertia must take."""

from __future__ import annotations

import numpy as np

from app.diagnosis.models.dynamic.smoothing import Motion
from app.diagnosis.observations.effort import GAIN, STIFFNESS
from app.diagnosis.observations.joint_log import Log
from app.diagnosis.thresholds.naming_logs import MOST_UNSURE
from app.errors import MissingColumnError
from app.kinematics import RobotModel
from app.kinematics.dynamics import inverse_dynamics
from app.recordings import Table

ENOUGH = 4000  # samples the estimate looks at


def estimated_gains(
    log: Log, robot: RobotModel, motion: Motion, table: Table
) -> tuple[np.ndarray, np.ndarray]:
    """Gains [Nm/A], or stiffnesses of servos [Nm/rad or N/m], and their standard deviations, (n,) each.

    The current (or servo error) of a joint is its rigid torque over the gain, plus friction: both are fitted.

    Of servos, a joint that carries too little to tell its stiffness has that of the others in the middle (1 where none
    tells it), and infinite uncertainty: what is found on it is in units of that.

    Raises:
        MissingColumnError: a joint carries too little for its gain to show (currents).
    """
    index = np.unique(np.linspace(0, len(log.t) - 1, ENOUGH).astype(int))
    q, qd, qdd = (values[index] for values in (motion.q, motion.qd, motion.qdd))
    rigid = inverse_dynamics(robot, q, qd, qdd)
    gains, sigmas = np.empty(robot.joint_count), np.empty(robot.joint_count)
    for j in range(robot.joint_count):
        ones = np.ones(len(index))
        columns = np.stack([rigid[:, j], np.sign(qd[:, j]), qd[:, j], qdd[:, j], ones], axis=1)
        size = np.linalg.norm(columns, axis=0)
        columns = columns[:, size > 0] / size[size > 0]
        theta, *_ = np.linalg.lstsq(columns, log.y[index, j], rcond=1e-10)
        left = log.y[index, j] - columns @ theta
        # Neighbouring samples hang together: a tenth of them count.
        sigma = np.sqrt(left @ left / max(len(index) / 10 - len(theta), 1))
        spread = sigma / np.sqrt(10.0) * np.sqrt(np.linalg.pinv(columns.T @ columns)[0, 0])
        slope = theta[0] / size[0] if size[0] > 0 else 0.0
        error = spread * np.sqrt(10.0) / size[0] if size[0] > 0 else np.inf
        if not slope > 0 or error > MOST_UNSURE * slope:
            if log.lacking == STIFFNESS:
                gains[j], sigmas[j] = np.nan, np.inf
                continue
            raise MissingColumnError(
                f"motor currents without drive gains, and joint {j + 1} carries too little to tell its own",
                file=table.path,
                row=1,
                column=GAIN,
                expected=f"a line '# drive_gain_Nm_per_A: [..]' with {robot.joint_count} numbers",
            )
        gains[j], sigmas[j] = 1.0 / slope, error / slope**2
    told = np.isfinite(gains)
    gains[~told] = float(np.median(gains[told])) if told.any() else 1.0
    return gains, sigmas
