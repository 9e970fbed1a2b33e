"""Is it the recording? Columns that were swapped, turned round or scaled explain a gross misfit at one stroke."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from app.diagnosis.motion.log import Log
from app.errors import InputError
from app.kinematics import RobotModel
from app.kinematics.dynamics import inverse_dynamics
from app.recordings import Table
from app.units import DEG_PER_RAD

HOPELESS = 0.8  # share left beyond which the torques do not belong to this arm at all
GROSS = 0.04  # share of the torques' variance that is left unexplained before anything is suspected
BETTER = 0.1  # of that must be left with the columns put right
ENOUGH = 600
WEAK = 0.02  # a torque that varies less than this share of the largest cannot speak


def check_columns(
    log: Log,
    robot: RobotModel,
    motion: tuple[np.ndarray, np.ndarray, np.ndarray],
    torque: np.ndarray,
    table: Table,
) -> float:
    """Refuses a log whose columns are plainly not what they are called.

    Returns:
        the share of the torques' variance that the description leaves, friction fitted.

    Raises:
        InputError: which columns, and what they look like.
    """
    if not robot.has_inertials:
        return 0.0
    index = np.unique(np.linspace(0, len(log.t) - 1, ENOUGH).astype(int))
    q, qd, qdd = (values[index] for values in motion)
    tau = torque[index]
    usual = _left(robot, q, qd, qdd, tau)
    if usual < GROSS:
        return usual
    trials: list[tuple[float, str, str]] = []
    n = robot.joint_count
    for a, b in combinations(range(n), 2):
        order = list(range(n))
        order[a], order[b] = b, a
        name = f"joints {a + 1} and {b + 1} look swapped"
        trials.append(
            (
                _left(robot, q[:, order], qd[:, order], qdd[:, order], tau),
                f"{name} in the positions",
                f"q{a + 1}",
            )
        )
        trials.append((_left(robot, q, qd, qdd, tau[:, order]), f"{name} in the torques", f"tau{a + 1}"))
        both = _left(robot, q[:, order], qd[:, order], qdd[:, order], tau[:, order])
        trials.append((both, name, f"q{a + 1}"))
    for a in range(n):
        turned = np.where(np.arange(n) == a, -1.0, 1.0)
        what = f"joint {a + 1} looks counted the other way round"
        trials.append((_left(robot, q * turned, qd * turned, qdd * turned, tau), what, f"q{a + 1}"))
        trials.append(
            (
                _left(robot, q, qd, qdd, tau * turned),
                f"the torque of joint {a + 1} looks turned round",
                f"tau{a + 1}",
            )
        )
    for a, other in [(a, other) for a in range(n) for other in ("degrees", "radians")]:
        factor = DEG_PER_RAD if other == "radians" else 1.0 / DEG_PER_RAD
        scaled = np.where(np.arange(n) == a, factor, 1.0)
        what = f"the values of joint {a + 1} look like {other}"
        trials.append((_left(robot, q * scaled, qd * scaled, qdd * scaled, tau), what, f"q{a + 1}"))
    trials.append((_left(robot, q, qd, qdd, -tau), "all torques look turned round", "tau1"))
    for factor, what in (
        (1 / DEG_PER_RAD, "degrees marked as radians?"),
        (DEG_PER_RAD, "radians marked as degrees?"),
    ):
        trials.append((_left(robot, q * factor, qd * factor, qdd * factor, tau), what, "q1"))
    share, what, column = min(trials)
    if share < BETTER * usual:
        named = table.columns[column].name if column in table.columns else column
        raise InputError(
            f"{what}: the description then explains {1 - share:.0%} of the torques, and {1 - usual:.0%} as it is",
            file=table.path,
            row=table.header_row,
            column=named,
            expected="columns in the robot's joint order, sense and unit",
        )

    return usual


def _left(robot: RobotModel, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray, tau: np.ndarray) -> float:
    """Mean share of each joint's torque variance left by the description with friction and offset fitted."""
    residual = tau - inverse_dynamics(robot, q, qd, qdd)
    shares, least = [], len(q) * (WEAK * float(np.std(tau, axis=0).max())) ** 2
    for j in range(q.shape[1]):
        spread = float(np.sum((tau[:, j] - tau[:, j].mean()) ** 2))
        if spread <= 0:
            continue
        spread = max(spread, least)
        columns = np.stack([np.sign(qd[:, j]), qd[:, j], qdd[:, j], np.ones(len(q))], axis=1)
        theta, *_ = np.linalg.lstsq(columns, residual[:, j], rcond=1e-8)
        left = residual[:, j] - columns @ theta
        shares.append(min(float(left @ left) / spread, 4.0))
    return float(np.mean(shares)) if shares else 0.0
