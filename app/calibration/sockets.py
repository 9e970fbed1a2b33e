"""One tool, many touched points: recordings of `kind: touch` where rows with the same target touched the same point.

    minimise sum_i |R_i t + p_i - s_target(i)|^2   over t and every s

Targets that were placed together (`p3_h0`, `p3_h1`: what stands before the underscore) form a placement. Leaving one
placement out at a time tells two things that residuals cannot: how well the tool of the others predicts it, and how far
the tool point really wanders, because an arm's own errors are alike within a placement and not between them.

Source of the jackknife over groups: Efron and Stein (1981).
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from app.calibration.result import ToolCalibration
from app.calibration.wording import degenerate
from app.errors import DegenerateGeometryError, TooFewPointsError
from app.estimation import HALF, reach
from app.figures import unsigned
from app.geometry import Pose
from app.recordings import Table
from app.recordings.arm import robot_for
from app.units import mm

_SINGULAR = 1e-6
_LEAST_PLACEMENTS = 3


@dataclass(frozen=True, eq=False)
class Sockets:
    """One tool from many points.

    Args:
        name: the file.
        robot: the arm's title.
        flange: the link that was taken as its flange.
        result: the tool, its residuals and its covariance between placements where there are enough of them.
        targets: label of each point.
        points: (k, 3) the touched points in base [m].
        counts: touches of each.
        sigma_residual: (3,) standard error of the tool point if every touch erred on its own [m].
        placements: label of each placement.
        heldout: (m,) distance of each touch from its point when its placement had no say in the tool [m].
        tools: (placements, 3) the tool point with one placement left out [m].
    """

    name: str
    robot: str
    flange: str
    result: ToolCalibration
    targets: tuple[str, ...]
    points: np.ndarray
    counts: tuple[int, ...]
    sigma_residual: np.ndarray
    placements: tuple[str, ...]
    heldout: np.ndarray
    tools: np.ndarray

    def distances(self) -> list[tuple[str, str, float]]:
        """Pairs of points of one placement and how far apart they came out [m]."""
        return [
            (first, second, float(np.linalg.norm(self.points[i] - self.points[i + 1 + j])))
            for i, first in enumerate(self.targets)
            for j, second in enumerate(self.targets[i + 1 :])
            if _placement(first) == _placement(second)
        ]


def solve_sockets(table: Table, named: str | None = None) -> Sockets:
    """Solves a touch recording; `named` is the robot's address, None takes the header's.

    Raises:
        InputError: names the file, the row and the column.
        DegenerateGeometryError: too few touches of any point, or turns about one axis only.
    """
    robot = robot_for(table, named)
    q = table.numbers([f"q{j + 1}" for j in range(robot.joint_count)])
    labels = np.array(table.text("target"))
    frames = robot.chain.frames(q)
    rotations, positions = frames.flange_rotations, frames.flange_positions
    try:
        tool, normal = _tool(rotations, positions, labels)
    except DegenerateGeometryError as error:
        raise error.in_file(table.path) from None
    tips = rotations @ tool + positions
    residuals, delta = np.empty_like(tips), 0.0
    counts = Counter(labels.tolist())
    targets = tuple(counts)
    points = np.array([tips[labels == target].mean(axis=0) for target in targets])
    for target, point in zip(targets, points, strict=True):
        residuals[labels == target] = tips[labels == target] - point
        delta += float(np.sum(np.diff(tips[labels == target], axis=0) ** 2))
    dof = 3 * (len(labels) - len(targets)) - 3
    sigma = float(np.sqrt(np.sum(residuals**2) / dof)) if dof > 0 else 0.0
    covariance = np.linalg.inv(normal) * sigma**2
    own = np.sqrt(np.diag(covariance))
    placements, heldout, tools = _leave_placements_out(rotations, positions, labels)
    if len(tools) >= _LEAST_PLACEMENTS:
        apart = tools - tools.mean(axis=0)
        covariance = (len(tools) - 1.0) / len(tools) * apart.T @ apart
        dof = len(tools) - 1
    values = np.linalg.eigvalsh(normal)
    result = ToolCalibration(
        T_flange_tool=Pose.of(None, tool),
        p_base=points[0],
        method="joint",
        orientation="default",
        residual_vectors=residuals,
        delta=float(np.sqrt(delta)),
        covariance=covariance,
        sigma=sigma,
        dof=dof,
        condition=float(np.sqrt(values[-1] / values[0])),
        rank=3,
        rows=tuple(int(row) for row in table.rows),
        weights=np.ones(len(labels)),
    )
    numbers = tuple(counts[target] for target in targets)
    name = table.path.name
    return Sockets(
        name,
        robot.title,
        robot.flange,
        result,
        targets,
        points,
        numbers,
        own,
        placements,
        heldout,
        tools,
    )


def _tool(rotations: np.ndarray, positions: np.ndarray, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tool point (3,) and normal matrix (3, 3); each target's own mean is taken off first."""
    normal, rhs = np.zeros((3, 3)), np.zeros(3)
    for target in dict.fromkeys(labels.tolist()):
        mine = labels == target
        if mine.sum() < 2:
            continue
        turned = rotations[mine] - rotations[mine].mean(axis=0)
        moved = positions[mine] - positions[mine].mean(axis=0)
        normal += np.einsum("nij,nik->jk", turned, turned)
        rhs -= np.einsum("nij,ni->j", turned, moved)
    if not normal.any():
        raise degenerate("too_few", "too_few_sockets", kind=TooFewPointsError, rank=0, needed=3)
    values = np.linalg.eigvalsh(normal)
    if values[0] < _SINGULAR * max(values[-1], 1.0):
        rank = int((values > _SINGULAR * max(values[-1], 1.0)).sum())
        raise degenerate("one_axis", "one_axis_sockets", rank=rank, needed=3)
    return np.linalg.solve(normal, rhs), normal


def _leave_placements_out(
    rotations: np.ndarray, positions: np.ndarray, labels: np.ndarray
) -> tuple[tuple[str, ...], np.ndarray, np.ndarray]:
    groups = np.array([_placement(label) for label in labels])
    names = tuple(dict.fromkeys(groups.tolist()))
    heldout, tools = np.full(len(labels), np.nan), []
    for name in names:
        rest = groups != name
        if not rest.any():
            continue
        try:
            tool, _ = _tool(rotations[rest], positions[rest], labels[rest])
        except DegenerateGeometryError:
            continue
        tools.append(tool)
        for target in dict.fromkeys(labels[~rest].tolist()):
            tips = rotations[labels == target] @ tool + positions[labels == target]
            heldout[labels == target] = np.linalg.norm(tips - tips.mean(axis=0), axis=1)
    return names, heldout, np.array(tools).reshape(-1, 3)


def _placement(label: str) -> str:
    return label.partition("_")[0]


def sockets_page(found: Sockets) -> str:
    """Everything about one recording, for a person at a terminal."""
    result = found.result
    lines = [
        f"{found.name}: {len(result.per_point)} touches of {len(found.targets)} points in "
        f"{len(found.placements)} placements, {found.robot}, flange {found.flange}",
        "",
        "tool point in the flange [mm]   value   95% between placements   95% if every touch erred alone",
    ]
    between_half = reach(result.dof, dimensions=1) * mm(result.sigma_tool)
    own_half = HALF * mm(found.sigma_residual)  # from hundreds of touches
    for axis, value, between, own in zip("xyz", mm(result.tool_point), between_half, own_half, strict=True):
        lines.append(f"  {axis}                     {value:>12.3f} ± {between:<20.3f} ± {own:.3f}")
    known = found.heldout[np.isfinite(found.heldout)]
    lines += [
        "",
        f"distance to the own point [mm]: mean {mm(result.mean):.3f}, max {mm(result.max):.3f} "
        f"(row {result.rows[result.worst]}), rms {mm(result.rms):.3f}",
        f"noise of one touch on one axis {mm(result.sigma):.3f} mm, condition {result.condition:.2f}",
    ]
    if len(known):
        lines.append(
            f"placement left out: mean {mm(known.mean()):.3f}, rms {mm(np.sqrt(np.mean(known**2))):.3f} mm "
            "(the tool of the other placements on this one)"
        )
    pairs = found.distances()
    if pairs:
        text = ", ".join(f"{a}-{b.partition('_')[2]} {mm(d):.2f}" for a, b, d in pairs)
        lines.append(f"points of one placement lie apart by [mm]: {text}")
    return unsigned("\n".join(lines))
