"""Makes static recordings with this package's own exact forward model (the independent one is in proof)."""

from pathlib import Path

import numpy as np

from app.diagnosis.effects.effect import Place
from app.diagnosis.models.kinematic.cell import pose
from app.diagnosis.models.kinematic.situation import situation_for
from app.diagnosis.models.kinematic.terms import Term, apply_terms, effects
from app.geometry import exp_so3
from app.recordings import read_table
from app.units import from_mm, mm

NOISE_MM = 0.15
TOOL = np.array([0.05, -0.03, 0.2])
SECONDS_A_ROW = 60.0


def poses(robot, rng, count, span=2.0):
    """Random joint positions around home, within limits."""
    low = np.maximum(robot.lower, robot.home - span)
    high = np.minimum(robot.upper, robot.home + span)
    return rng.uniform(low, high, (count, robot.joint_count))


def term(key, where, values, **fixed):
    """A term as the engine applies it."""
    return Term(
        effects()[key], Place(where, fixed, scan="from_row" in where), np.atleast_1d(np.array(values, float))
    )


def tracker_rows(robot, q, terms=(), *, noise=NOISE_MM, rng, time=None, distort=None, reflectors=(TOOL,)):
    """(m, r, 3) [m] measured points; `distort(q)` replaces the true joints for laws that have no name."""
    situation = situation_for(robot, q, time=np.arange(len(q)) * SECONDS_A_ROW if time is None else time)
    cell = apply_terms(situation, tuple(terms))
    if distort is not None:
        for joint, amount in distort(situation).items():
            cell = cell.add_joint(joint - 1, amount)
    posed = pose(situation, cell, np.array(reflectors))
    rotation, origin = exp_so3(np.array([0.02, -0.03, 0.9])), np.array([2.5, -1.5, 0.4])
    points = posed.points @ rotation.T + origin
    distance = np.linalg.norm(points, axis=-1)
    points = points * (cell.scale[:, None] + cell.zero[:, None] / distance)[:, :, None]
    return points + from_mm(rng.normal(0, noise, points.shape))


def write_tracker(
    path: Path, robot, q, points, *, noise=NOISE_MM, stated=True, keys=(), extra=None, seconds=None
):
    """Writes a tracker recording and reads it back."""
    names = [f"q{j + 1}_{'m' if joint.prismatic else 'rad'}" for j, joint in enumerate(robot.joints)]
    for r in range(points.shape[1]):
        names += [f"{c}{'' if r == 0 else r + 1}_mm" for c in "xyz"]
    body = [q, mm(points.reshape(len(q), -1))]
    names.append("t_s")
    body.append((np.arange(len(q)) * SECONDS_A_ROW if seconds is None else seconds)[:, None])
    for name, column in (extra or {}).items():
        names.append(name)
        body.append(np.asarray(column)[:, None])
    lines = ["# kind: tracker", *keys]
    if stated:
        lines.append(f"# noise_mm: {noise}")
    lines.append(",".join(names))
    lines += [",".join(f"{v:.10g}" for v in row) for row in np.concatenate(body, axis=1)]
    path.write_text("\n".join(lines) + "\n")
    return read_table(path)


def write_touch(path: Path, robot, q, targets, *, keys=()):
    """Writes a touch recording and reads it back."""
    names = [f"q{j + 1}_{'m' if joint.prismatic else 'rad'}" for j, joint in enumerate(robot.joints)]
    lines = ["# kind: touch", *keys, ",".join([*names, "target"])]
    lines += [",".join([*(f"{v:.10g}" for v in row), str(t)]) for row, t in zip(q, targets, strict=True)]
    path.write_text("\n".join(lines) + "\n")
    return read_table(path)
