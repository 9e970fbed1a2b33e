"""Every axis turned alone: where the real axes lie, beside the description.

Between neighbouring axes j and j+1: `a`, their distance; `twist`, the angle between them about their common
perpendicular. For axes that are parallel by the description the perpendicular has no place of its own, so `a` is
taken where axis j+1 was measured, and `lean` is the second angle, out of the plane of `twist`. Along axis j:
`d`, from one perpendicular's foot to the next; `zero`, the angle between the two perpendiculars, less the
description's: the zero error of joint j. Each with its uncertainty.

Source: circle point analysis, Mooring, Roth, Driels (1991), chapter 5; parallel axes after Hayati (1983).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.frame import Axes
from app.calibration.base.sense import wrapped
from app.kinematics import RobotModel

_CROSSING = 0.1  # sine above which two axes count as crossing
_STEP = 1e-6
_ZERO = 1e-6  # m, a length that is none


@dataclass(frozen=True)
class Quantity:
    """One dimension of the arm.

    Args:
        name: `a`, `twist`, `lean`, `d` or `zero`.
        axis: of axis j (and j+1 for a, twist, lean).
        measured, sigma, nominal: [m] or [rad]; nominal is None without a description.
    """

    name: str
    axis: int
    measured: float
    sigma: float
    nominal: float | None

    @property
    def angular(self) -> bool:
        return self.name in ("twist", "lean", "zero")

    @property
    def error(self) -> float | None:
        """Measured less nominal."""
        if self.nominal is None:
            return None
        gap = self.measured - self.nominal
        return float(wrapped(np.array(gap))) if self.angular else gap


@dataclass(frozen=True)
class Turning:
    """How far an axis turned for what the controller showed.

    Args:
        axis: its number.
        slope: place on the circle over shown angle; 1 for a gear ratio that is right.
        sigma: one-sigma of it, from the scatter of the places.
        scatter: [rad] rms of place minus shown angle after the slope.
    """

    axis: int
    slope: float
    sigma: float
    scatter: float


@dataclass(frozen=True, eq=False)
class ArmGeometry:
    """The real arm's axes: what the arcs say, beside the description."""

    quantities: tuple[Quantity, ...]
    turning: tuple[Turning, ...]


@dataclass(frozen=True, eq=False)
class _Line:
    point: np.ndarray
    direction: np.ndarray


def arm_geometry(arcs: Sequence[ArcFit], robot: RobotModel | None, rest: np.ndarray | None) -> ArmGeometry:
    """Lengths and twists of the arm whose axes were turned.

    Args:
        arcs: axis 1, 2, 3 … without a gap.
        robot: the description; it also says which neighbours are parallel. None judges that by the arcs.
        rest: (joints,) [rad] where each joint stood while others turned; needed with `robot`.
    """
    axes = [found.axes for found in arcs]
    nominal = _nominal_lines(robot, rest, len(arcs)) if robot is not None and rest is not None else None
    if nominal is not None:
        axes = [a.reversed_where(np.array(_against(axes, nominal, j))) for j, a in enumerate(axes)]
    centres = [found.centre for found in arcs]
    out: list[Quantity] = []
    reference = nominal or [_Line(a.point, a.direction) for a in axes]
    crossing = [
        float(np.linalg.norm(np.cross(reference[j].direction, reference[j + 1].direction))) > _CROSSING
        for j in range(len(axes) - 1)
    ]

    def add(name: str, j: int, function: Callable[[Sequence[_Line]], float], used: Sequence[int]) -> None:
        value, sigma = _with_sigma(function, axes, used)
        wanted = None if nominal is None else function(nominal)
        length = name in ("a", "d")
        if length and (value if wanted is None or abs(wanted) < _ZERO else wanted) < 0:
            # which way a perpendicular counts is a convention: lengths are given as the description's are, positive
            value, wanted = -value, None if wanted is None else -wanted
        elif not length and wanted is not None:
            wanted = float(wrapped(np.array(wanted)))
            value = wanted + float(wrapped(np.array(value - wanted)))
        out.append(Quantity(name, j + 1, value, sigma, wanted))

    for j, cross in enumerate(crossing):
        at = None if cross else centres[j + 1]
        base = None if nominal is None or cross else nominal[j + 1].point
        add("a", j, lambda s, j=j, at=at, n=base: _length(s, j, at, n, nominal), (j, j + 1))
        add("twist", j, lambda s, j=j, c=cross, at=at, n=base: _twist(s, j, c, at, n, nominal), (j, j + 1))
        if not cross:
            add("lean", j, lambda s, j=j, at=at, n=base: _lean(s, j, at, n, nominal), (j, j + 1))
    for j in range(1, len(axes) - 1):
        ends = (None if crossing[j - 1] else centres[j], None if crossing[j] else centres[j + 1])
        if crossing[j - 1] and crossing[j]:
            add("d", j, lambda s, j=j: _step_along(s, j), (j - 1, j, j + 1))
        if nominal is not None:
            add(
                "zero",
                j,
                lambda s, j=j, e=ends, c=crossing: _joint_angle(s, j, e, c, nominal),
                (j - 1, j, j + 1),
            )
    return ArmGeometry(tuple(out), tuple(t for t in map(turning, arcs) if t is not None))


def turning(found: ArcFit) -> Turning | None:
    """The slope of place over shown angle; None without angles."""
    gap, angles = found.sense.gap, found.arc.angles
    if gap is None or angles is None or found.sense.sign == 0:
        return None
    large = found.used & (found.fit.radii > 0.2 * found.fit.radii.max())[found.groups]
    x, y = found.sense.sign * angles[large], gap[large]
    groups = np.eye(found.groups.max() + 1)[found.groups[large]]
    columns = np.column_stack([x, groups[:, groups.any(axis=0)]])
    solution, *_ = np.linalg.lstsq(columns, y, rcond=None)
    left = y - columns @ solution
    dof = len(y) - columns.shape[1]
    if dof <= 0:
        return None
    variance = float(left @ left) / dof
    sigma = float(np.sqrt(variance * np.linalg.pinv(columns.T @ columns)[0, 0]))
    return Turning(found.arc.axis, 1.0 + float(solution[0]), sigma, float(np.sqrt(np.mean(left**2))))


def _nominal_lines(robot: RobotModel, rest: np.ndarray, count: int) -> list[_Line] | None:
    if robot.joint_count < count or robot.joint_count != len(rest):
        return None
    frames = robot.chain.frames(rest[None])
    return [_Line(frames.joint_positions[0, j], frames.axes[0, j]) for j in range(count)]


def _against(axes: Sequence[Axes], nominal: Sequence[_Line], j: int) -> bool:
    """True where a line points against the description's, judged by the frame of the first two."""

    def frame(one: np.ndarray, two: np.ndarray) -> np.ndarray:
        y = np.cross(one, two)
        y = y / np.linalg.norm(y)
        return np.stack([y, np.cross(one, y), one])

    n1, n2 = nominal[0].direction, nominal[1].direction
    z = 1.0 if n1[2] >= 0 else -1.0
    found = frame(axes[0].direction, axes[1].direction) @ axes[j].direction
    # axes 1 and 2 were signed by right-handed angles about Z and Y; bring the description's to the same
    y = 1.0 if n2 @ np.cross(z * n1, nominal[1].point - nominal[0].point) >= 0 else -1.0
    wanted = frame(z * n1, y * n2) @ nominal[j].direction
    return bool(found @ wanted < 0)


def _with_sigma(
    function: Callable[[Sequence[_Line]], float], axes: Sequence[Axes], used: Sequence[int]
) -> tuple[float, float]:
    """Value and one-sigma by central differences over shift and tilt of every axis used."""
    lines = [_Line(a.point, a.direction) for a in axes]
    variance = 0.0
    for j in used:
        gradient = np.empty(4)
        for k in range(4):
            ends = []
            for sign in (1.0, -1.0):
                moved = list(lines)
                moved[j] = _nudged(axes[j], k, sign * _STEP)
                ends.append(function(moved))
            gradient[k] = float(wrapped(np.array(ends[0] - ends[1]))) / (2 * _STEP)
        variance += float(gradient @ axes[j].covariance @ gradient)
    return function(lines), float(np.sqrt(variance))


def _nudged(axis: Axes, which: int, step: float) -> _Line:
    if which < 2:
        return _Line(axis.point + step * axis.basis[which], axis.direction)
    direction = axis.direction + step * axis.basis[which - 2]
    return _Line(axis.point, direction / np.linalg.norm(direction))


def _perpendicular(lines, j, at, nominal_at, nominal) -> tuple[np.ndarray, np.ndarray, float]:
    """From line j to line j+1: foot on line j, unit direction, length. `at` is None for crossing axes."""
    one, two = lines[j], lines[j + 1]
    if at is None:
        normal = np.cross(one.direction, two.direction)
        sine2 = float(normal @ normal)
        between = two.point - one.point
        along = float(np.cross(between, two.direction) @ normal) / sine2
        unit = normal / np.sqrt(sine2)
        return one.point + along * one.direction, unit, float(between @ unit)
    place = nominal_at if lines is nominal else at
    place = two.point + float((place - two.point) @ two.direction) * two.direction  # stays on line j+1
    arm = place - one.point
    across = arm - float(arm @ one.direction) * one.direction
    length = float(np.linalg.norm(across))
    return place - across, across / max(length, 1e-12), length


def _length(lines, j, at, nominal_at, nominal) -> float:
    return _perpendicular(lines, j, at, nominal_at, nominal)[2]


def _twist(lines, j, crossing, at, nominal_at, nominal) -> float:
    _, x, _ = _perpendicular(lines, j, at, nominal_at, nominal)
    z, d = lines[j].direction, lines[j + 1].direction
    return (
        float(np.arctan2(-d @ np.cross(z, x), d @ z))
        if not crossing
        else float(np.arctan2(np.linalg.norm(np.cross(z, d)), d @ z))
    )


def _lean(lines, j, at, nominal_at, nominal) -> float:
    _, x, _ = _perpendicular(lines, j, at, nominal_at, nominal)
    return float(np.arcsin(np.clip(lines[j + 1].direction @ x, -1.0, 1.0)))


def _step_along(lines, j) -> float:
    before = _perpendicular(lines, j - 1, None, None, None)
    after = _perpendicular(lines, j, None, None, None)
    foot = before[0] + before[2] * before[1]  # on line j
    return float((after[0] - foot) @ lines[j].direction)


def _joint_angle(lines, j, ends, crossing, nominal) -> float:
    at = [None if end is None else nominal[j + k].point for k, end in enumerate(ends)]
    before = _perpendicular(lines, j - 1, ends[0], at[0], nominal)[1]
    after = _perpendicular(lines, j, ends[1], at[1], nominal)[1]
    z = lines[j].direction
    return float(np.arctan2(z @ np.cross(before, after), before @ after))
