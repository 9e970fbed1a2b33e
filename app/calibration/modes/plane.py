"""The tip on a flat plate with different orientations: no spike is needed, and the plate need not be known.

    n . (R_i t + p_i) = d + e_i          unknown: t (3), the plane's normal n (2) and distance d (1)

For a given n the rest is linear; several normals are tried and the best is refined. What the touches tell is only the
distance to the plate, so it takes more of them, tilted further, than a spike.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture, Demo, Step, of_role, stack
from app.calibration.modes._touches import DEMO_SPIKE, DEMO_TOOL, demo_flange, demo_turn
from app.calibration.result import ToolCalibration
from app.calibration.tool import checked
from app.calibration.wording import degenerate
from app.errors import TooFewPointsError
from app.estimation import Fit, gauss_newton
from app.geometry import Pose
from app.units import from_mm

_STARTS = 60
_NAMES = ("x", "y", "z", "tilt_a", "tilt_b", "distance")
_UNITS = ("m", "m", "m", "rad", "rad", "m")
#: Condition beyond which some direction of the tool point is not determined.
_SINGULAR = 1e5


@dataclass(frozen=True)
class Plane:
    key: str = "plane"
    title: str = "Touches of a flat plate"
    least_touches: int = 7
    most_touches: int = 30
    default_touches: int = 9

    def steps(self, touches: int = 9) -> tuple[Step, ...]:
        count = min(max(touches, self.least_touches), self.most_touches)
        text = (
            "Tilt the tool another way, nearly upright and far over in turn, put its tip on the plate, anywhere, "
            "and record."
        )
        return tuple(Step(f"plane{i}", "plane", f"Plate {i}", text, "plane") for i in range(1, count + 1))

    def solve(
        self, captures: Sequence[Capture], *, context: dict[str, Any] | None = None, **_: Any
    ) -> ToolCalibration:
        """The tool point; its axes stay the flange's.

        Raises:
            TooFewPointsError: fewer than seven touches.
            DegenerateGeometryError: tilted too little, or about one axis.
        """
        touches = of_role(captures, "plane")
        if len(touches) < self.least_touches:
            raise degenerate(
                "too_few",
                "too_few_plane",
                kind=TooFewPointsError,
                rank=len(touches),
                needed=self.least_touches,
                count=len(touches),
            )
        rotations, positions = stack(touches)
        fit, normal = _fit(rotations, positions)
        if fit.rank < 6 or not fit.condition < _SINGULAR:
            raise degenerate("one_axis", "one_axis_plane", rank=min(fit.rank, 5), needed=6)
        tool, distance = fit.values[:3], fit.values[5]
        tips = rotations @ tool + positions
        heights = tips @ normal - distance
        pull = fit.covariance / fit.sigma**2 if fit.sigma > 0 else np.zeros((6, 6))
        jacobian = _jacobian(rotations, tips, normal)
        gains = -(pull[:3] @ jacobian.T).T[:, :, None] * normal  # (n, 3, 3)
        result = ToolCalibration(
            T_flange_tool=Pose.of(None, tool),
            p_base=(tips - heights[:, None] * normal).mean(axis=0),
            method=self.key,
            orientation="default",
            residual_vectors=heights[:, None] * normal,
            delta=float(np.linalg.norm(np.diff(heights))),
            covariance=fit.covariance[:3, :3],
            sigma=fit.sigma,
            dof=fit.dof,
            condition=fit.condition,
            rank=3,
            rows=tuple(c.row or i + 1 for i, c in enumerate(touches)),
            gains=gains,
            weights=np.ones(len(touches)),
        )
        return checked(result, captures, context)

    def demo(self, *, touches: int = 9, noise: float = 0.0, seed: int = 0) -> Demo:
        rng = np.random.default_rng(seed)
        captures = []
        for number, step in enumerate(self.steps(touches), 1):
            across = np.array([*rng.uniform(-from_mm(200.0), from_mm(200.0), 2), 0.0])
            turn = demo_turn(rng, number, rng.uniform(0.3, 0.9))
            captures.append(
                Capture(step.key, step.role, demo_flange(rng, DEMO_SPIKE + across, turn, noise), None, number)
            )
        return Demo(tuple(captures), Pose.of(None, DEMO_TOOL.position), {})


def _jacobian(rotations: np.ndarray, tips: np.ndarray, normal: np.ndarray) -> np.ndarray:
    a, b = _beside(normal)
    turned = np.einsum("nij,i->nj", rotations, normal)
    return np.column_stack([turned, tips @ a, tips @ b, -np.ones(len(tips))])


def _beside(normal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two directions that make a square frame with `normal`."""
    helper = np.eye(3)[np.argmin(np.abs(normal))]
    a = np.cross(normal, helper)
    a /= np.linalg.norm(a)
    return a, np.cross(normal, a)


def _fit(rotations: np.ndarray, positions: np.ndarray) -> tuple[Fit, np.ndarray]:
    """The best plane and tool point from several first guesses of the normal."""
    index = np.arange(_STARTS) + 0.5  # half a sphere of directions, evenly spread
    height, around = 1.0 - index / _STARTS, index * np.pi * (1.0 + np.sqrt(5.0))
    flat = np.sqrt(1.0 - height**2)
    guesses = np.column_stack([flat * np.cos(around), flat * np.sin(around), height])
    best: list[tuple[float, np.ndarray, np.ndarray]] = []
    for normal in guesses:
        turned = np.einsum("nij,i->nj", rotations, normal)
        matrix = np.column_stack([turned, -np.ones(len(positions))])
        rhs = -positions @ normal
        solution = np.linalg.lstsq(matrix, rhs, rcond=1e-9)[0]
        cost = float(np.sum((matrix @ solution - rhs) ** 2))
        best.append((cost, normal, solution))
    best.sort(key=lambda entry: entry[0])
    fits = [_refine(rotations, positions, normal, solution) for _, normal, solution in best[:6]]
    return min(fits, key=lambda pair: pair[0].sse)


def _refine(
    rotations: np.ndarray, positions: np.ndarray, normal: np.ndarray, solution: np.ndarray
) -> tuple[Fit, np.ndarray]:
    # State: tool (3), normal (3), distance; the step's two tilts turn the normal and stay small.
    def function(state: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        tips = rotations @ state[:3] + positions
        return -(tips @ state[3:6] - state[6]), _jacobian(rotations, tips, state[3:6])

    def update(state: np.ndarray, step: np.ndarray) -> np.ndarray:
        a, b = _beside(state[3:6])
        turned = state[3:6] + step[3] * a + step[4] * b
        return np.r_[state[:3] + step[:3], turned / np.linalg.norm(turned), state[6] + step[5]]

    start = np.r_[solution[:3], normal, solution[3]]
    raw = gauss_newton(function, start, names=_NAMES, units=_UNITS, update=update, max_iterations=100)
    state = raw.values
    values = np.r_[state[:3], 0.0, 0.0, state[6]]
    fit = Fit(
        _NAMES, _UNITS, values, raw.covariance, raw.residuals, raw.dof, raw.sigma, raw.sigma_source, raw.rank,
        raw.condition, raw.converged, raw.message, raw.iterations,
    )  # fmt: skip
    return fit, state[3:6]


MODE = Plane()
