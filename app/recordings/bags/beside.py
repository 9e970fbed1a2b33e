"""What a bag holds beside joint states, brought to the times of the arm's rows."""

from __future__ import annotations

import numpy as np

from app.recordings.bags.choosing import Fit
from app.recordings.bags.collecting import Series
from app.units import mm

_WRENCH = ("force_x_N", "force_y_N", "force_z_N", "torque_x_Nm", "torque_y_Nm", "torque_z_Nm")
_LATE = 0.5  # s: beyond, a value of another topic is not of this row


def commanded(asked: Fit, t: np.ndarray, slides: tuple[bool, ...]) -> dict[str, np.ndarray]:
    """qc1_rad… at the times t (m,) [s]."""
    values = asked.series.values("q")[:, list(asked.columns)]
    return {
        f"qc{j}_{'m' if slides[j - 1] else 'rad'}": _at(asked.series.times(), column, t)
        for j, column in enumerate(values.T, 1)
    }


def temperatures(found: list[Series], names: tuple[str, ...], t: np.ndarray) -> dict[str, np.ndarray]:
    """temperature1_degC… where a topic's frames are the joints' names."""
    by_name = {s.names[0]: s for s in found if s.kind == "temperature"}
    if not all(name in by_name for name in names):
        return {}
    return {
        f"temperature{j}_degC": _at(
            by_name[name].times(), by_name[name].values("temperature")[:, 0], t, wide=True
        )
        for j, name in enumerate(names, 1)
    }


def wrenches(found: list[Series], t: np.ndarray) -> dict[str, np.ndarray]:
    """Force [N] and torque [Nm] of the fullest wrench topic; columns that are kept and ignored."""
    series = max((s for s in found if s.kind == "wrench"), key=lambda s: s.count, default=None)
    if series is None or series.count < 2:
        return {}
    values = series.values("wrench")
    return {name: _at(series.times(), values[:, k], t) for k, name in enumerate(_WRENCH)}


def tracked(points: Series, arm: Fit, slides: tuple[bool, ...]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Rows of a tracker recording: the joints interpolated to the stamp of every point.

    Returns:
        (m,) times [s] and the columns q1_rad…, x_mm… (and qw…, where poses were recorded).
    """
    t = points.times()
    own = arm.series.times()
    inside = (t >= own.min()) & (t <= own.max())
    t = t[inside]
    values = points.values(points.kind)[inside]
    columns = {
        f"q{j}_{'m' if slides[j - 1] else 'rad'}": _at(own, column, t)
        for j, column in enumerate(arm.series.values("q")[:, list(arm.columns)].T, 1)
    }
    columns |= {f"{axis}_mm": mm(values[:, k]) for k, axis in enumerate("xyz")}
    if values.shape[1] == 7:
        columns |= {f"q{axis}": values[:, 3 + k] for k, axis in enumerate("wxyz")}
    return t, columns


def _at(own: np.ndarray, values: np.ndarray, t: np.ndarray, *, wide: bool = False) -> np.ndarray:
    """Values (m,) at other times, between neighbours; NaN far from any of them."""
    good = np.isfinite(own) & np.isfinite(values)
    if good.sum() < 2:
        return np.full(len(t), np.nan)
    order = np.argsort(own[good], kind="stable")
    times, numbers = own[good][order], values[good][order]
    out = np.interp(t, times, numbers)
    nearest = np.abs(times[np.clip(np.searchsorted(times, t), 1, len(times) - 1)] - t)
    before = np.abs(times[np.clip(np.searchsorted(times, t) - 1, 0, len(times) - 1)] - t)
    return out if wide else np.where(np.minimum(nearest, before) > _LATE, np.nan, out)
