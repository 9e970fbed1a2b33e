"""How much noise the measurement has, and how that is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.result import Noise
from app.diagnosis.thresholds.repeats import LEAST_REPEATS
from app.units import mm

if TYPE_CHECKING:
    from app.diagnosis.models.kinematic.state import State


_SQRT12 = np.sqrt(12.0)


@dataclass(frozen=True)
class NoiseLevel:
    """One-sigma noise of a position component [m], where it is known before any fit; `dof` of that knowledge."""

    sigma: float | None
    source: str
    dof: float


def known_noise(recording: StaticRecording) -> NoiseLevel:
    """From repeated poses, else as stated."""
    repeats = _repeats(recording)
    if repeats is not None:
        return repeats
    if recording.stated_noise is not None:
        return NoiseLevel(recording.stated_noise, "stated", np.inf)
    return NoiseLevel(None, "residual", 0.0)


def _repeats(recording: StaticRecording) -> NoiseLevel | None:
    """Pooled scatter of rows that repeat one pose."""
    if recording.mode == "targets" or len(np.unique(recording.pose)) == recording.size:
        return None
    # A pose taken again from the other side shows play, which is no noise: only repeats approached alike count.
    group = np.column_stack([recording.pose, recording.session, recording.situation.approach])
    alike = np.unique(group, axis=0, return_inverse=True)[1].reshape(-1)
    # Rows of one pose may differ slightly in their angles; only true repeats are used.
    source = recording.lengths if recording.mode == "length" else recording.points
    assert source is not None
    values = source.reshape(recording.size, -1)
    count = np.bincount(alike)
    rows = count[alike] > 1
    spread = np.abs(recording.q - _means(recording.q, alike)).max()
    if not rows.any() or spread > 1e-4:
        return None
    difference = values - _means(values, alike)
    seen = np.isfinite(difference) & rows[:, None]
    dof = float(seen.sum() - values.shape[1] * np.count_nonzero(count > 1))
    if dof < LEAST_REPEATS:
        return None
    return NoiseLevel(float(np.sqrt(np.sum(difference[seen] ** 2) / dof)), "repeats", dof)


def _means(values: np.ndarray, group: np.ndarray) -> np.ndarray:
    count = np.bincount(group).astype(float)
    sums = np.zeros((len(count), values.shape[1]))
    np.add.at(sums, group, values)
    return (sums / count[:, None])[group]


def rounding_noise(recording: StaticRecording, state: State) -> float:
    """One-sigma position noise that the written digits alone make [m]: of the angles and of the lengths."""
    points, frames = state.posed.points[:, 0], state.posed.frames
    arms = recording.situation.chain.jacobian_columns(frames, points)  # (m, 3, n)
    lever = np.sqrt(np.mean(np.sum(arms**2, axis=2)))
    return float(np.hypot(lever * recording.angle_resolution, recording.length_resolution) / _SQRT12)


def noise_of(
    recording: StaticRecording, known: NoiseLevel, state: State, kept: np.ndarray, freedom: float
) -> Noise:
    """What the diagnosis reports as its noise floor.

    Args:
        state: of the final model, base and tool fitted.
        kept: (m,) rows that count.
        freedom: (0..1) part of the measured values that the fit has not used up.
    """
    if known.sigma is not None:
        return Noise(mm(known.sigma), "mm", "repeats" if known.source == "repeats" else "stated")
    sigma = residual_rms(state, kept) / np.sqrt(freedom)
    rounded = rounding_noise(recording, state)
    if rounded > 0.5 * sigma:
        return Noise(mm(rounded), "mm", "resolution")
    return Noise(mm(sigma), "mm", "residual")


def residual_rms(state: State, kept: np.ndarray) -> float:
    """Root mean square of the position components [m] over the rows kept."""
    counted = state.recording.present & ~state.recording.angular & kept[:, None]
    return float(np.sqrt(np.mean(state.residual[counted] ** 2))) if counted.any() else 0.0
