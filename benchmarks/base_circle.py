"""Circles and base frames from tracker points, beside scikit-spatial, circle-fit and scipy's least_squares.

Run: python -m benchmarks.base_circle        (scikit-spatial and circle-fit join where they are installed)
"""

from __future__ import annotations

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before numpy is imported; one thread for both sides

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from app.calibration.base.arcs import Arc, Arcs
from app.calibration.base.batch import solve_cells
from app.calibration.base.solve import solve_base
from app.geometry import exp_so3
from app.geometry.circle import fit_axis
from benchmarks.rows import Row, quickest

POINTS, CELLS, ROUNDS, SIGMA = 36, 10_000, 60, 30e-6
SHORT = np.radians(60.0)


def arcs(cells: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Arcs of axis 1 and axis 2, (m, 36, 3) [m], of arms that stand anywhere; rows in the order of motion."""
    one, two = np.linspace(-1.4, 1.4, POINTS), np.linspace(-1.0, 0.9, POINTS)
    first = np.stack([1.7 * np.cos(one), 1.7 * np.sin(one), np.full(POINTS, 0.9)], -1)
    second = np.stack([0.3 + 1.5 * np.cos(two), np.zeros(POINTS), -1.5 * np.sin(two)], -1)
    turn, place = exp_so3(rng.normal(size=(cells, 3))), rng.uniform(-3, 3, (cells, 1, 3))
    moved = [p @ np.swapaxes(turn, 1, 2) + place for p in (first, second)]
    return moved[0] + rng.normal(0, SIGMA, moved[0].shape), moved[1] + rng.normal(0, SIGMA, moved[1].shape)


def general(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centre and axis by scipy.optimize.least_squares on the same distances, from the plane and the mean."""
    centre = points.mean(axis=0)
    normal = np.linalg.svd(points - centre)[2][2]
    start = np.array([*centre, np.arccos(normal[2]), np.arctan2(normal[1], normal[0]), 1.0])

    def distances(x: np.ndarray) -> np.ndarray:
        n = np.array([np.sin(x[3]) * np.cos(x[4]), np.sin(x[3]) * np.sin(x[4]), np.cos(x[3])])
        d = points - x[:3]
        h = d @ n
        return np.concatenate([h, np.linalg.norm(d - h[:, None] * n, axis=1) - x[5]])

    x = least_squares(distances, start, x_scale="jac").x
    n = np.array([np.sin(x[3]) * np.cos(x[4]), np.sin(x[3]) * np.sin(x[4]), np.cos(x[3])])
    return x[:3] + ((points.mean(axis=0) - x[:3]) @ n) * n, n


def algebraic() -> tuple[str, Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]]:
    """A peer's plane and its circle in that plane: scikit-spatial with circle-fit, scikit-spatial, or scipy."""
    try:
        from skspatial.objects import Circle, Plane
    except ImportError:
        return "scipy least_squares", general
    try:
        from circle_fit import hyperLSQ
    except ImportError:
        hyperLSQ = None

    def fit(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        plane = Plane.best_fit(points)
        n = np.array(plane.normal)
        e1 = np.array(points[0] - plane.point)
        e1 = e1 - (e1 @ n) * n
        e1 = e1 / np.linalg.norm(e1)
        e2 = np.cross(n, e1)
        flat = (points - np.array(plane.point)) @ np.stack([e1, e2], axis=1)
        u, v = hyperLSQ(flat)[:2] if hyperLSQ else Circle.best_fit(flat).point
        return np.array(plane.point) + u * e1 + v * e2, n

    return "scikit-spatial plane + " + ("circle-fit hyperLSQ" if hyperLSQ else "its circle"), fit


def peer_frame(fit: Callable, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """The patent's frame from a peer's two axes: no sign rules, no uncertainty, no checks."""
    (p1, z), (p2, d2) = fit(first), fit(second)
    n = np.cross(z, d2)
    x = n / np.linalg.norm(n)
    origin = p1 + (np.cross(p2 - p1, d2) @ n) / (n @ n) * z
    return np.column_stack([x, np.cross(z, x), z, origin])


def run() -> list[Row]:
    """Every line of the table."""
    rng = np.random.default_rng(0)
    name, fit = algebraic()
    first, second = arcs(CELLS, rng)
    rows = []
    one, two = first[0], second[0]
    numbers, zero = np.arange(POINTS), np.zeros(POINTS, int)
    source = Arcs(Path("cell"), {1: Arc(1, one, None, numbers, zero), 2: Arc(2, two, None, numbers, zero)})
    frame = quickest(lambda: solve_base(source), ROUNDS)
    rows.append(
        Row("base on 2 x 36 points, signs, covariance, all checks", frame,
            quickest(lambda: peer_frame(fit, one, two), ROUNDS), f"{name}: frame only", "s", 2e-3)
    )  # fmt: skip
    bare = quickest(lambda: solve_cells(first[:1], second[:1], SIGMA, SIGMA), ROUNDS)
    rows.append(Row("the same without checks", bare, quickest(lambda: peer_frame(general, one, two), ROUNDS),
                    "scipy least_squares: frame only"))  # fmt: skip
    rows.append(Row("one circle of 36 points, with covariance", quickest(lambda: fit_axis(one), ROUNDS),
                    quickest(lambda: general(one), ROUNDS), "scipy least_squares, no covariance"))  # fmt: skip
    many = quickest(lambda: solve_cells(first, second, SIGMA, SIGMA), 3)
    start = time.process_time()
    for k in range(100):
        peer_frame(fit, first[k], second[k])
    looped = (time.process_time() - start) * CELLS / 100
    rows.append(Row("10,000 cells in one call", many, looped, f"{name}, in a loop (100 timed)"))
    rows.append(_accuracy(name, fit, rng))
    return rows


def _accuracy(name: str, fit: Callable, rng: np.random.Generator) -> Row:
    """Error of the centre on short arcs: what an algebraic circle loses."""
    t = np.linspace(0, SHORT, 12)
    points = np.stack([1.5 * np.cos(t), 1.5 * np.sin(t), np.zeros(12)], -1) + rng.normal(
        0, 5e-5, (1000, 12, 3)
    )
    ours = np.sqrt(np.mean(np.sum(fit_axis(points).centres[:, 0, :2] ** 2, axis=1)))
    peer = np.sqrt(np.mean([np.sum(fit(p)[0][:2] ** 2) for p in points]))
    return Row("centre error, 12 points on 60 degrees, r 1.5 m, 0.05 mm", ours * 1e3, peer * 1e3, name, "mm")


if __name__ == "__main__":
    for row in run():
        print(
            f"{row.name:<58}{row.ours:>12.4g} {row.unit:<3} peer {row.peer:>10.4g}  x{row.ratio:.3f}  {row.peer_name}"
        )
