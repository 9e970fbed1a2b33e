"""Load data: what hangs on the flange, found by moving the arm, as makers have it: four poses of the wrist and a run.

The arm that is weighed is simulated here from its description, a point mass and dry and viscous friction; the search
that finds the mass knows only the log. The log states that the description is exact, as it is here: with masses of
links off by a fifth, as a drawing's are, four turns of a wrist do not tell a load from what is off in the last links.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.diagnosis.dispatch import diagnose_file
from app.diagnosis.result import Progress
from app.estimation import HALF
from app.geometry import angle_between, skew
from app.kinematics import RobotModel, load_robot
from app.kinematics.dynamics import inverse_dynamics
from app.kinematics.robot import GRAVITY
from app.session.steps.load import POSES
from app.units import from_deg

#: Degrees from home, pose by pose: the elbow, then the three joints of the wrist. The elbow lifts the arm's own weight,
#: which is known, beside the load's: with the wrist alone the elbow and the joint before it feel one torque all the
#: time, and a gain that is off by 3% passes for half of an IRB 120's load (± 0.22 kg of 0.31; with the elbow ± 0.015).
_TURNS = ((0, 0, 0, 0), (-25, 60, 30, 0), (25, -60, 30, 60), (-10, 0, -45, -90))
APART = from_deg(30.0)  # the flange has to be turned by at least so much between two poses
_RATE = 100.0  # Hz
_STAND, _MOVE = 1.0, 2.5  # s at each pose, and on the way to the next
_ROUNDS = 3
_NOISE = 0.002  # of each joint's largest torque
_FRICTION = 0.02  # the same, dry
_VISCOUS = 0.01  # the same, at 1 rad/s
_LIGHTEST, _HEAVIEST = 0.02, 0.05  # of the arm's mass
_OUT = (0.03, 0.12)  # m, of the centre from the flange


@dataclass(frozen=True)
class LoadData:
    """A mass [kg] and its centre (3,) in the flange [m]; with their 95% half widths where they were found."""

    mass: float
    centre: tuple[float, float, float]
    mass_half: float = 0.0
    centre_half: tuple[float, float, float] = (0.0, 0.0, 0.0)


def hidden_load(robot: RobotModel, seed: int) -> LoadData:
    """What hangs there, drawn by the seed."""
    rng = np.random.default_rng([seed, 0x10AD])
    mass = float(robot.chain.masses.sum()) * rng.uniform(_LIGHTEST, _HEAVIEST)
    sideways = rng.uniform(-_OUT[0], _OUT[0], 2)
    return LoadData(float(mass), (float(sideways[0]), float(sideways[1]), float(rng.uniform(*_OUT))))


def proposed(robot: RobotModel) -> np.ndarray:
    """(4, n) poses that differ as much as elbow and wrist allow, from home."""
    poses = np.tile(robot.home, (POSES, 1))
    poses[:, -len(_TURNS[0]) :] += from_deg(np.array(_TURNS, float))
    return np.clip(poses, robot.lower, robot.upper)


def least_turn(robot: RobotModel, poses: np.ndarray) -> float:
    """Smallest turn of the flange between two of the poses (m, n) [rad]; pi with fewer than two."""
    rotations = np.array([robot.forward(q).rotation for q in poses])
    pairs = np.triu_indices(len(poses), 1)
    return float(angle_between(rotations[pairs[0]], rotations[pairs[1]]).min()) if len(poses) > 1 else np.pi


def run_through(poses: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """t (m,), and q, qd, qdd (m, n) of a run that stands at each pose and goes smoothly to the next, three rounds."""
    order = [k % len(poses) for k in range(_ROUNDS * len(poses) + 1)]
    stand, move = round(_STAND * _RATE), round(_MOVE * _RATE)
    s = np.arange(move) / move
    rise = 10 * s**3 - 15 * s**4 + 6 * s**5
    speed, push = (30 * s**2 - 60 * s**3 + 30 * s**4) / _MOVE, 60 * s * (1 - s) * (1 - 2 * s) / _MOVE**2
    q, qd, qdd = [], [], []
    for here, there in itertools.pairwise(order):
        way = poses[there] - poses[here]
        rest = np.zeros((stand, len(way)))
        q += [np.tile(poses[here], (stand, 1)), poses[here] + rise[:, None] * way]
        qd += [rest, speed[:, None] * way]
        qdd += [rest, push[:, None] * way]
    joined = [np.concatenate(part) for part in (q, qd, qdd)]
    return np.arange(len(joined[0])) / _RATE, joined[0], joined[1], joined[2]


def weigh(robot: str, poses: np.ndarray, seed: int, folder: Path, say: Progress) -> LoadData | None:
    """The arm runs through the poses with the hidden load, and the search says what hangs there, or None.

    Args:
        robot: a shipped robot's name, or the address of another.
        poses: (4, n) [rad].
        seed: draws the load and the noise.
        folder: where the log is written.
    """
    log = write_log(load_robot(robot), poses, seed, folder)
    found = diagnose_file(log, robot=robot, progress=say)
    for finding in found.findings:
        if finding.effect == "payload":
            values = {p.name: p for p in finding.parameters}
            centre = [values[f"com_{c}"] for c in "xyz"]
            x, y, z = (p.value for p in centre)
            dx, dy, dz = (HALF * p.std for p in centre)
            return LoadData(values["mass"].value, (x, y, z), HALF * values["mass"].std, (dx, dy, dz))
    return None


def write_log(robot: RobotModel, poses: np.ndarray, seed: int, folder: Path) -> Path:
    """The run as a joint log."""
    t, q, qd, qdd = run_through(poses)
    load, rng = hidden_load(robot, seed), np.random.default_rng([seed, 0x4015E])
    torque = inverse_dynamics(robot, q, qd, qdd) + _of_load(robot, q, load)
    scale = np.maximum(np.abs(torque).max(axis=0), 1.0)
    torque += scale * (_FRICTION * np.tanh(qd / 0.02) + _VISCOUS * qd)
    torque += _NOISE * scale * rng.normal(size=torque.shape)
    n = robot.joint_count
    names = ["t_s", *(f"q{j}_rad" for j in range(1, n + 1)), *(f"qd{j}_rad_s" for j in range(1, n + 1))]
    names += [f"tau{j}_Nm" for j in range(1, n + 1)]
    head = f"# kind: motion\n# robot: {robot.name}\n# inertials: exact\n{','.join(names)}\n"
    path = folder / f"load_{seed}.csv"
    with path.open("w", encoding="utf-8") as file:
        file.write(head)
        np.savetxt(file, np.column_stack([t, q, qd, torque]), fmt="%.6f", delimiter=",")
    return path


def _of_load(robot: RobotModel, q: np.ndarray, load: LoadData) -> np.ndarray:
    """(m, n) torques that a point mass asks for [Nm]: J^T m (a - g) at its centre, a by differences over time."""
    poses = [robot.forward(row) for row in q]
    centre = np.array(load.centre)
    arms = np.array([pose.rotation @ centre for pose in poses])
    places = np.array([pose.position for pose in poses]) + arms
    pull = np.gradient(np.gradient(places, 1.0 / _RATE, axis=0), 1.0 / _RATE, axis=0) - GRAVITY
    out = np.empty(q.shape)
    for k, row in enumerate(q):
        jacobian = robot.jacobian(row)
        out[k] = load.mass * (jacobian[:3] - skew(arms[k]) @ jacobian[3:]).T @ pull[k]
    return out


def off(found: LoadData, true: LoadData) -> tuple[float, float]:
    """Error of the mass as a share of it, and of the centre [m]."""
    apart = float(np.linalg.norm(np.subtract(found.centre, true.centre)))
    return abs(found.mass - true.mass) / true.mass, apart
