"""Circles in space by orthogonal distance, many at a time, with what is known of them afterwards.

A point that turns about an axis stays on a circle, so the axis is what is fitted: a line, and for every
group of points that was carried at one place (one reflector) a height along the line and a radius. One group
is a circle in space; several groups share one axis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.geometry.line import cross, dot

#: Names of the unknowns: the axis shifted in its normal plane, tilted, then height and radius of each group.
SHIFT, TILT = slice(0, 2), slice(2, 4)
_STEP = 1e-10  # relative to the radius; convergence is quadratic, so the next step would be nothing
_ITERATIONS = 40


@dataclass(frozen=True, eq=False)
class AxisFit:
    """A turning axis with G circles about it; every array may carry a batch in front.

    The unknowns, in the order of `covariance`: shift along e1 and e2 [m], tilt towards e1 and e2 [rad], then
    height [m] of each group, then radius [m] of each group. A tilt turns the direction by `a e1 + b e2` about
    `point`.

    Args:
        point: (..., 3) [m] on the axis, at the mean height of the points.
        basis: (..., 3, 3), rows e1, e2 and the direction.
        heights: (..., G) [m] of the circles' planes above `point`.
        radii: (..., G) [m].
        residuals: (..., n, 2) [m] of every point: along the axis, and outwards from its circle.
        azimuths: (..., n) [rad] of every point about the axis, from e1 towards e2.
        covariance: (..., 4+2G, 4+2G) for a noise of one (multiply by its variance) or, with weights that are
            1/sigma^2, as it stands.
        dof: (...,) residual components left over.
        sse: (...,) weighted sum of squared residuals.
        converged: (...,) False where the iteration ran out.
        jacobian: (..., n, 2, 4+2G) of the residuals, unweighted.
    """

    point: np.ndarray
    basis: np.ndarray
    heights: np.ndarray
    radii: np.ndarray
    residuals: np.ndarray
    azimuths: np.ndarray
    covariance: np.ndarray
    dof: np.ndarray
    sse: np.ndarray
    converged: np.ndarray
    jacobian: np.ndarray

    @property
    def direction(self) -> np.ndarray:
        """(..., 3) unit; its sign says nothing yet."""
        return self.basis[..., 2, :]

    @property
    def centres(self) -> np.ndarray:
        """(..., G, 3) [m] of the circles."""
        return self.point[..., None, :] + self.heights[..., None] * self.direction[..., None, :]


def _plane_basis(points: np.ndarray, weights: np.ndarray, group: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centre of all points, and the basis whose last row is normal to every group's own plane."""
    share = weights[..., None] * group  # (..., n, G)
    total = share.sum(axis=-2)
    means = np.einsum("...ng,...nk->...gk", share, points) / np.maximum(total, 1e-300)[..., None]
    centred = (points - np.einsum("ng,...gk->...nk", group, means)) * np.sqrt(weights)[..., None]
    _, vectors = np.linalg.eigh(np.swapaxes(centred, -1, -2) @ centred)  # ascending
    direction, e1 = vectors[..., :, 0], vectors[..., :, 2]
    basis = np.stack([e1, cross(direction, e1), direction], axis=-2)
    centre = np.einsum("...n,...nk->...k", weights, points) / weights.sum(axis=-1)[..., None]
    return centre, basis


def _start(points, weights, group) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Plane by its scatter, then the algebraic circle in it: point, basis, typical radius."""
    centre, basis = _plane_basis(points, weights, group)
    local = np.einsum("...jk,...nk->...nj", basis, points - centre[..., None, :])
    x, y = local[..., 0], local[..., 1]
    size = np.sqrt(np.einsum("...n,...n->...", weights, x * x + y * y) / weights.sum(axis=-1))
    size = np.where(size > 0, size, 1.0)
    x, y = x / size[..., None], y / size[..., None]
    groups = group.shape[1]
    a = np.empty((*x.shape, 2 + groups))
    a[..., 0], a[..., 1], a[..., 2:] = 2 * x, 2 * y, group  # x^2 + y^2 = 2 x cx + 2 y cy + k_g
    normal = np.swapaxes(a, -1, -2) @ (a * weights[..., None])
    right = np.einsum("...ni,...n->...i", a, weights * (x * x + y * y))
    scale = 1e-14 * np.trace(normal, axis1=-2, axis2=-1)[..., None, None]
    solution = np.linalg.solve(normal + scale * np.eye(2 + groups), right[..., None])[..., 0]
    shift = solution[..., :2] * size[..., None]
    point = centre + np.einsum("...j,...jk->...k", shift, basis[..., :2, :])
    return point, basis, size


def fit_axis(
    points: np.ndarray, weights: np.ndarray | None = None, groups: np.ndarray | None = None
) -> AxisFit:
    """The axis whose circles lie nearest to the points, by orthogonal distance.

    Minimises sum w_i (h_i^2 + (rho_i - r_g)^2): h_i the distance of a point from its circle's plane, rho_i its
    distance from the axis. Gauss-Newton from the algebraic circle; all of a batch at once.

    Args:
        points: (..., n, 3) [m].
        weights: (..., n), 1/variance or any relative weight; 0 leaves a point out (so arcs of different length
            can share a batch). Default 1.
        groups: (n,) whole numbers from 0, which circle a point belongs to. Default one circle.

    Returns:
        AxisFit. Degenerate points (one line, too few) give a covariance with infinities, never an exception.

    Source: Ahn, Rauh, Warnecke (2001), "Least-squares orthogonal distances fitting of circle ...", here in
    axis coordinates; the start is Kåsa (1976).
    """
    points = np.asarray(points, float)
    batch, n = points.shape[:-2], points.shape[-2]
    weights = np.ones((*batch, n)) if weights is None else np.broadcast_to(weights, (*batch, n)).astype(float)
    numbers = np.zeros(n, int) if groups is None else np.asarray(groups, int)
    group = np.eye(int(numbers.max()) + 1)[numbers]  # (n, G)
    count = group.shape[1]
    point, basis, size = _start(points, weights, group)
    share = weights[..., None] * group
    share = share / np.maximum(share.sum(axis=-2, keepdims=True), 1e-300)
    total = weights.sum(axis=-1)

    converged = np.zeros(batch, bool)
    view = _view(points, share, weights / total[..., None], group, point, basis)
    for _ in range(_ITERATIONS):
        rows = view.columns(group).reshape(*batch, 2 * n, 4 + 2 * count)
        both = np.repeat(weights, 2, axis=-1)
        normal = np.swapaxes(rows, -1, -2) @ (rows * both[..., None])
        residual = view.residuals.reshape(*batch, 2 * n)
        step = -_solve(normal, np.einsum("...ni,...n->...i", rows, both * residual))
        move = np.abs(step[..., :2]).max(axis=-1) / size + np.abs(step[..., 2:4]).max(axis=-1)
        step = step * np.minimum(1.0, 0.5 / np.maximum(move, 1e-300))[..., None]  # a far start may overshoot
        step = np.where(converged[..., None], 0.0, step)
        point = view.point + np.einsum("...j,...jk->...k", step[..., :2], basis[..., :2, :])
        basis = _tilted(basis, step[..., 2:4])
        view = _view(points, share, weights / total[..., None], group, point, basis)
        converged = converged | (move < _STEP)
        if converged.all():
            break

    columns = view.columns(group)
    covariance, rank = _covariance(columns, weights)
    sse = np.einsum("...n,...nk,...nk->...", weights, view.residuals, view.residuals)
    azimuths, dof = np.arctan2(view.y, view.x), 2 * np.count_nonzero(weights > 0, axis=-1) - rank
    return AxisFit(
        view.point,
        basis,
        view.heights,
        view.radii,
        view.residuals,
        azimuths,
        covariance,
        dof,
        sse,
        converged,
        columns,
    )


@dataclass(frozen=True, eq=False)
class _View:
    """The points as the axis sees them; heights and radii, which are linear, already at their best."""

    point: np.ndarray
    x: np.ndarray
    y: np.ndarray
    height: np.ndarray
    rho: np.ndarray
    heights: np.ndarray
    radii: np.ndarray
    residuals: np.ndarray

    def columns(self, group: np.ndarray) -> np.ndarray:
        """d residual / d unknown, (..., n, 2, 4+2G): rows 'along' and 'outwards'."""
        n, groups = group.shape
        safe = np.where(self.rho > 0, self.rho, 1.0)
        x_unit, y_unit = self.x / safe, self.y / safe
        out = np.zeros((*self.x.shape[:-1], n, 2, 4 + 2 * groups))
        out[..., 0, 2], out[..., 0, 3] = self.x, self.y
        out[..., 1, 0], out[..., 1, 1] = -x_unit, -y_unit
        out[..., 1, 2], out[..., 1, 3] = -self.height * x_unit, -self.height * y_unit
        out[..., 0, 4 : 4 + groups] = -group
        out[..., 1, 4 + groups :] = -group
        return out


def _view(points, share, unit_weights, group, point, basis) -> _View:
    local = (points - point[..., None, :]) @ np.swapaxes(basis, -1, -2)
    middle = np.einsum("...n,...n->...", unit_weights, local[..., 2])
    point = point + middle[..., None] * basis[..., 2, :]
    x, y, height = local[..., 0], local[..., 1], local[..., 2] - middle[..., None]
    rho = np.sqrt(x * x + y * y)
    heights = np.einsum("...ng,...n->...g", share, height)
    radii = np.einsum("...ng,...n->...g", share, rho)
    residuals = np.stack([height - heights @ group.T, rho - radii @ group.T], axis=-1)
    return _View(point, x, y, height, rho, heights, radii, residuals)


def _scaled(normal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit diagonal, so that metres and radians compare."""
    scale = np.sqrt(np.maximum(np.diagonal(normal, axis1=-2, axis2=-1), 1e-300))
    return normal / (scale[..., :, None] * scale[..., None, :]), scale


def _solve(normal: np.ndarray, gradient: np.ndarray) -> np.ndarray:
    scaled, scale = _scaled(normal)
    scaled = scaled + 1e-14 * np.eye(scaled.shape[-1])
    return np.linalg.solve(scaled, (gradient / scale)[..., None])[..., 0] / scale


def _tilted(basis: np.ndarray, tilt: np.ndarray) -> np.ndarray:
    """The basis after its last row has turned by tilt (a, b) towards e1 and e2, orthonormal again."""
    e1, e2, direction = basis[..., 0, :], basis[..., 1, :], basis[..., 2, :]
    direction = direction + tilt[..., :1] * e1 + tilt[..., 1:] * e2
    direction = direction / np.sqrt(dot(direction, direction))[..., None]
    e1 = e1 - dot(e1, direction)[..., None] * direction
    e1 = e1 / np.sqrt(dot(e1, e1))[..., None]
    return np.stack([e1, cross(direction, e1), direction], axis=-2)


def _covariance(columns: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(J^T W J)^-1 and the rank; infinite variances where the rank is short."""
    *batch, n, _, p = columns.shape
    rows = columns.reshape(*batch, 2 * n, p) * np.sqrt(np.repeat(weights, 2, axis=-1))[..., None]
    scaled, scale = _scaled(np.swapaxes(rows, -1, -2) @ rows)
    values, vectors = np.linalg.eigh(scaled)
    good = values > 1e-13
    inverse = np.where(good, 1.0 / np.where(good, values, 1.0), 0.0)
    covariance = (vectors * inverse[..., None, :]) @ np.swapaxes(vectors, -1, -2)
    covariance = covariance / (scale[..., :, None] * scale[..., None, :])
    rank = good.sum(axis=-1)
    short = (rank < p)[..., None, None] & np.eye(p, dtype=bool)
    return np.where(short, np.inf, covariance), rank
