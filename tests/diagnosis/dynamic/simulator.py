"""Joint logs with known truth for tests: a swinging arm, pin's inverse dynamics, laws written out by hand.

Shares the rigid-body part with what it tests and none of the laws.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from app.kinematics import RobotModel
from app.kinematics.dynamics import flange_to_last_link, inverse_dynamics, point_mass
from app.kinematics.regressor import torque_regressor
from app.recordings import Table, read_table

HARMONICS = 4


@dataclass
class Swing:
    """A run: time, position, speed, acceleration, and the torque that is added to up to writing."""

    robot: RobotModel
    t: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    torque: np.ndarray
    noise: np.ndarray = field(default_factory=lambda: np.zeros(0))


def swing(robot: RobotModel, rng: np.random.Generator, *, samples: int = 3000, rate: float = 100.0) -> Swing:
    """A random sum of sines that stays inside the limits and below two thirds of a usual speed."""
    n = robot.joint_count
    t = np.arange(samples) / rate
    base = 2 * np.pi * 0.1
    low, high = np.clip(robot.lower, -2.5, 2.5), np.clip(robot.upper, -2.5, 2.5)
    q, qd, qdd = np.zeros((3, samples, n))
    for j in range(n):
        phase = rng.uniform(0, 2 * np.pi, HARMONICS)
        share = rng.uniform(0.3, 1.0, HARMONICS)
        share *= 0.45 * (high[j] - low[j]) * rng.uniform(0.5, 1.0) / share.sum()
        middle = 0.5 * (high[j] + low[j])
        q[:, j] = middle
        for k in range(HARMONICS):
            w = base * (k + 1)
            q[:, j] += share[k] * np.sin(w * t + phase[k])
            qd[:, j] += share[k] * w * np.cos(w * t + phase[k])
            qdd[:, j] -= share[k] * w**2 * np.sin(w * t + phase[k])
    return Swing(robot, t, q, qd, qdd, inverse_dynamics(robot, q, qd, qdd))


def add_load(run: Swing, mass: float, com, since: float = 0.0) -> None:
    columns = torque_regressor(run.robot, run.q, run.qd, run.qdd)[:, :, -10:]
    body = flange_to_last_link(run.robot) @ point_mass(mass, np.array(com))
    run.torque += (run.t >= since)[:, None] * (columns @ body)


def measure(run: Swing, rng: np.random.Generator, noise: float = 0.05, memory: float = 0.0) -> None:
    """Adds noise of one sigma `noise` [Nm] times the joint's torque range over its mean, white or remembering."""
    n = run.robot.joint_count
    sigma = noise * np.maximum(np.std(run.torque, axis=0), 0.5)
    e = rng.normal(0, 1, run.torque.shape)
    if memory:
        for i in range(1, len(e)):
            e[i] = memory * e[i - 1] + np.sqrt(1 - memory**2) * e[i]
    run.noise = sigma
    run.torque = run.torque + sigma * e
    assert run.torque.shape[1] == n


def write(run: Swing, path: Path, *, speed: bool = False, digits: int = 6, header: str = "") -> Table:
    """The run as a CSV; gives it as read back."""
    n = run.robot.joint_count
    names = ["t_s", *[f"q{j + 1}_rad" for j in range(n)]]
    columns = [run.t[:, None], run.q]
    if speed:
        names += [f"qd{j + 1}_rad_s" for j in range(n)]
        columns.append(run.qd)
    names += [f"tau{j + 1}_Nm" for j in range(n)]
    columns.append(run.torque)
    with path.open("w") as file:
        file.write(f"# kind: motion\n{header}" + ",".join(names) + "\n")
        np.savetxt(file, np.concatenate(columns, axis=1), fmt=f"%.{digits}f", delimiter=",")
    return read_table(path)
