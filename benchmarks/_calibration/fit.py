"""Gauss-Newton over base, tool, touched points and the arm's deviations; held-out errors; rows far off set aside."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from benchmarks._calibration.chain import Chain, Deviation
from benchmarks._calibration.readings import Readings

#: What is fitted beside base, tool and touched points.
NOTHING, GEOMETRY, ELASTIC = "base and tool", "full geometry", "geometry and elasticity"
FOLDS = 10
#: Residuals beyond this many robust standard deviations (1.4826 MAD) are set aside, as calibration tools do.
FAR = 4.5
#: Deviations are scaled by what is usual in an arm: 1 mrad, 1 mm, 10 urad/Nm. Combinations of them whose
#: singular value is below this share of the largest are not fitted: the poses do not show them.
TRUNCATED = 1e-3
WIDTHS = (1e-3, 1e-3, 1e-3, 1e-5)
#: More rows than this share far off are no outliers: the model is wrong for them, and all are kept.
MOST_FAR = 0.2
STEPS, HALVINGS, SETTLED = 30, 8, 1e-6


@dataclass(frozen=True, eq=False)
class Fit:
    """What was found.

    Args:
        deviation: of the arm.
        base: (S, 4, 4) instrument in base, by session.
        tools: (S, P, 3) reflectors in the last joint's frame [m].
        targets: (T, 3) touched points in base [m].
    """

    deviation: Deviation
    base: np.ndarray
    tools: np.ndarray
    targets: np.ndarray


def residual(chain: Chain, readings: Readings, fit: Fit) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Measured minus predicted in base, and what takes it away.

    Returns:
        (m, P, 3) [m], NaN where nothing was measured; (m, P, 3, s) how it falls with each number of the set-up: base
        moved and turned, reflectors, touched points; (m, P, 3, 8 n) with each deviation of the arm.
    """
    session = readings.session
    torque = np.zeros_like(readings.q) if readings.torque is None else readings.torque
    points, moved, rotation = chain.points(readings.q, fit.tools[session], fit.deviation, torque)
    sessions, reflectors, _ = fit.tools.shape
    touched = readings.target >= 0
    measured = np.einsum("mab,mpb->mpa", fit.base[session, :3, :3], readings.points)
    measured += fit.base[session, None, :3, 3]
    measured[touched] = fit.targets[readings.target[touched], None]
    setup = np.zeros((*points.shape, 6 * sessions + 3 * sessions * reflectors + 3 * len(fit.targets)))
    for s in range(sessions):
        mine = session == s
        free = mine & ~touched
        for a, axis in enumerate(np.eye(3)):
            setup[free, :, :, 6 * s + a] = -axis
            setup[free, :, :, 6 * s + 3 + a] = -np.cross(axis, measured[free])
            for p in range(reflectors):
                column = 6 * sessions + 3 * (s * reflectors + p) + a
                setup[mine, p, :, column] = rotation[mine, :, a]
    at = 6 * sessions + 3 * sessions * reflectors
    for a in range(3):
        setup[np.flatnonzero(touched), :, a, at + 3 * readings.target[touched] + a] = -1.0
    return measured - points, setup, moved


def start(chain: Chain, readings: Readings) -> Fit:
    """Tool at the last joint's origin, base by the rotation that fits best, touched points at their means."""
    sessions, reflectors = int(readings.session.max()) + 1, readings.points.shape[1]
    nothing = Deviation.none(chain.n)
    fit = Fit(
        nothing,
        np.tile(np.eye(4), (sessions, 1, 1)),
        np.zeros((sessions, reflectors, 3)),
        np.zeros((int(readings.target.max(initial=-1)) + 1, 3)),
    )
    points, _, _ = chain.points(readings.q, fit.tools[readings.session], nothing, np.zeros_like(readings.q))
    for s in range(sessions):
        mine = (readings.session == s) & np.isfinite(readings.points[:, 0, 0]) & (readings.target < 0)
        if mine.any():
            here, there = points[mine, 0], readings.points[mine, 0]
            turn = Rotation.align_vectors(here - here.mean(0), there - there.mean(0))[0].as_matrix()
            fit.base[s, :3, :3], fit.base[s, :3, 3] = turn, here.mean(0) - turn @ there.mean(0)
    for t in range(len(fit.targets)):
        fit.targets[t] = points[readings.target == t, 0].mean(0)
    return fit


def solve(chain: Chain, readings: Readings, what: str, first: Fit | None = None) -> Fit:
    """Least squares from `first`: base, tool and touched points, then the arm's deviations beside them.

    The deviation of `first` stays as it is where `what` is NOTHING.
    """
    fit = start(chain, readings) if first is None else first
    if what != NOTHING:
        fit = solve(chain, readings, NOTHING, fit)
    free_arm = _free(chain, readings, what)
    left, setup, moved = residual(chain, readings, fit)
    for _ in range(STEPS):
        good = np.isfinite(left).reshape(-1)
        y = left.reshape(-1)[good]
        reached = float(y @ y)
        step = _step(y, setup.reshape(len(good), -1)[good], moved.reshape(len(good), -1)[good], free_arm)
        for _ in range(HALVINGS):
            after = _moved(fit, *step)
            left, setup, moved = residual(chain, readings, after)
            error = float(np.nansum(left**2))
            if error <= reached:
                break
            step = (step[0] / 2.0, step[1] / 2.0)
        else:
            return fit
        fit = after
        if error >= (1.0 - SETTLED) * reached:
            break
    return fit


def _free(chain: Chain, readings: Readings, what: str) -> np.ndarray:
    """(8 n, k) directions in which the arm may deviate, each as wide as is usual.

    The place of joint 1 is the base's. Touches at unknown points have no scale (an arm of no size would touch one
    point always), so that the longest link keeps its length.
    """
    n = chain.n
    if what == NOTHING:
        return np.zeros((8 * n, 0))
    directions = np.diag(np.repeat(WIDTHS, [n, 3 * n, 3 * n, n]))
    kept = np.ones(8 * n, bool)
    kept[[*range(n, n + 3), *range(4 * n, 4 * n + 3)]] = False
    kept[7 * n :] = what == ELASTIC
    if (readings.target >= 0).all():
        longest = 1 + int(np.argmax(np.linalg.norm(chain.offsets[1:], axis=1)))
        at = slice(n + 3 * longest, n + 3 * longest + 3)
        along = chain.offsets[longest] / np.linalg.norm(chain.offsets[longest])
        directions[at, at] -= np.outer(along, along) * WIDTHS[1]
    return directions[:, kept]


def _step(
    y: np.ndarray, setup: np.ndarray, moved: np.ndarray, free_arm: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Steps of set-up and arm that the linear problem asks for, the shortest one of the arm."""
    range_of, values, _ = np.linalg.svd(setup, full_matrices=False)
    range_of = range_of[:, values > 1e-9 * values[0]]
    columns = moved @ free_arm
    own = columns - range_of @ (range_of.T @ columns)
    arm = np.zeros(free_arm.shape[1])
    if len(arm):
        squares, directions = np.linalg.eigh(own.T @ own)
        largest = np.linalg.eigvalsh(columns.T @ columns)[-1]
        directions, squares = (
            directions[:, squares > TRUNCATED**2 * largest],
            squares[squares > TRUNCATED**2 * largest],
        )
        arm = directions @ ((directions.T @ (own.T @ y)) / squares)
    rest = np.linalg.lstsq(setup, y - columns @ arm, rcond=1e-9)[0]
    return rest, free_arm @ arm


def _moved(fit: Fit, setup: np.ndarray, deviation: np.ndarray) -> Fit:
    """One step of set-up and arm."""
    sessions, reflectors, _ = fit.tools.shape
    base = fit.base.copy()
    for s in range(sessions):
        step = setup[6 * s : 6 * s + 6]
        turn = Rotation.from_rotvec(step[3:]).as_matrix()
        base[s, :3, :3] = turn @ base[s, :3, :3]
        base[s, :3, 3] = turn @ base[s, :3, 3] + step[:3]
    at = 6 * sessions
    tools = fit.tools + setup[at : at + 3 * sessions * reflectors].reshape(fit.tools.shape)
    targets = fit.targets + setup[at + 3 * sessions * reflectors :].reshape(-1, 3)
    return Fit(Deviation.of(fit.deviation.flat + deviation), base, tools, targets)


@dataclass(frozen=True)
class Errors:
    """Root mean square of one component [m], on the rows fitted and on rows held out."""

    fitted: float
    heldout: float


def rms(left: np.ndarray) -> float:
    """Of the finite values; NaN of none."""
    finite = left[np.isfinite(left)]
    return float(np.sqrt(np.mean(finite**2))) if len(finite) else float("nan")


def near(chain: Chain, readings: Readings) -> np.ndarray:
    """(m,) False for rows whose residual of the full fit lies beyond FAR robust standard deviations; fitted twice.

    All True where that would be more than MOST_FAR of them.
    """
    keep = np.ones(len(readings.q), bool)
    for _ in range(2):
        fit = solve(chain, readings.part(keep), fullest(readings))
        left = residual(chain, readings, fit)[0].reshape(len(keep), -1)
        far = np.nanmax(np.abs(left), axis=1)
        sigma = 1.4826 * np.nanmedian(np.abs(left[keep]))
        keep = ~(far > FAR * sigma)
        if np.mean(~keep) > MOST_FAR:
            return np.ones(len(readings.q), bool)
    return keep


def fullest(readings: Readings) -> str:
    """Elasticity needs torques."""
    return GEOMETRY if readings.torque is None else ELASTIC


def errors(chain: Chain, readings: Readings, what: str, arm: Fit | None = None) -> Errors:
    """Error on the rows fitted and held out: tenfold by pose, everything fitted anew without the fold.

    Args:
        arm: a fit whose deviations are kept as they are (`what` is then NOTHING): learnt on other rows.
    """
    first = start(chain, readings)
    if arm is not None:
        first = replace(first, deviation=arm.deviation)
    whole = residual(chain, readings, solve(chain, readings, what, first))[0]
    poses, of_row = np.unique(readings.pose, return_inverse=True)
    order = np.argsort(np.argsort([int(np.argmax(of_row == k)) for k in range(len(poses))]))
    fold = order[of_row] % FOLDS
    out = np.full(whole.shape, np.nan)
    for k in range(FOLDS):
        held = fold == k
        if not held.any():
            continue
        kept = readings.part(~held)
        seen = np.isin(readings.target, kept.target) & np.isin(readings.session, kept.session)
        fit = solve(chain, kept, what, first)
        out[held & seen] = residual(chain, readings.part(held & seen), fit)[0]
    return Errors(rms(whole), rms(out))
