"""How much noise the measurement has, and how that is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.result import Noise
from app.diagnosis.static.fit import Fitted
from app.diagnosis.static.recording import StaticRecording
from app.units import mm

_LEAST_REPEATS = 8  # degrees of freedom below which repeats say too little
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
    # Rows of one pose may differ slightly in their angles; only true repeats are used.
    source = recording.lengths if recording.mode == "length" else recording.points
    assert source is not None
    values = source.reshape(recording.size, -1)
    count = np.bincount(recording.pose)
    rows = count[recording.pose] > 1
    spread = np.abs(recording.q - _means(recording.q, recording.pose)).max()
    if not rows.any() or spread > 1e-4:
        return None
    difference = values - _means(values, recording.pose)
    seen = np.isfinite(difference) & rows[:, None]
    dof = float(seen.sum() - values.shape[1] * np.count_nonzero(count > 1))
    if dof < _LEAST_REPEATS:
        return None
    return NoiseLevel(float(np.sqrt(np.sum(difference[seen] ** 2) / dof)), "repeats", dof)


def _means(values: np.ndarray, group: np.ndarray) -> np.ndarray:
    count = np.bincount(group).astype(float)
    sums = np.zeros((len(count), values.shape[1]))
    np.add.at(sums, group, values)
    return (sums / count[:, None])[group]


def rounding_noise(recording: StaticRecording, fitted: Fitted) -> float:
    """One-sigma position noise that the written digits alone make [m]: of the angles and of the lengths."""
    joint = fitted.columns.joint / np.where(fitted.weights > 0, fitted.weights, 1.0)[:, :, None]
    metric = ~recording.angular
    lever = np.sqrt(np.mean(np.sum(joint[:, metric] ** 2, axis=2)))
    return float(np.hypot(lever * recording.angle_resolution, recording.length_resolution) / _SQRT12)


def noise_of(recording: StaticRecording, known: NoiseLevel, fitted: Fitted) -> Noise:
    """What the diagnosis reports as its noise floor."""
    if known.sigma is not None:
        return Noise(mm(known.sigma), "mm", "repeats" if known.source == "repeats" else "stated")
    sigma = position_rms(fitted)
    rounded = rounding_noise(recording, fitted)
    if rounded > 0.5 * sigma:
        return Noise(mm(rounded), "mm", "resolution")
    return Noise(mm(sigma), "mm", "residual")


def position_rms(fitted: Fitted, corrected: bool = True) -> float:
    """Root mean square of the position components [m], by the degrees of freedom left."""
    return component_rms(fitted, ~fitted.recording.angular, corrected)


def component_rms(fitted: Fitted, which: np.ndarray, corrected: bool = True) -> float:
    """Of the components `which` (k,), each taking its share of the parameters."""
    present = fitted.recording.present[:, which]
    values = fitted.residual[:, which][present]
    if values.size == 0:
        return 0.0
    share = fitted.dof / max(fitted.size, 1) if corrected else 1.0
    return float(np.sqrt(np.mean(values**2) / share))


def weights_from(fitted: Fitted) -> np.ndarray:
    """(m, k) one over the spread of each kind of component, as the fit leaves it."""
    recording = fitted.recording
    sigma = np.empty(len(recording.angular))
    for kind in (False, True):
        which = recording.angular == kind
        if which.any():
            sigma[which] = max(component_rms(fitted, which), 1e-12)
    return recording.present / sigma


def starting_weights(recording: StaticRecording) -> np.ndarray:
    """(m, k) before any fit: a turn of one radian counts as a shift of 0.3 m."""
    sigma = np.where(recording.angular, 1e-3, 3e-4)
    return recording.present / sigma
