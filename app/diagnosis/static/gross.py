"""A misfit far beyond any arm's errors: is the recording written in another convention?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.static.conventions import FALL, LIKELIHOOD, Convention, conventions
from app.diagnosis.static.fit import Fitted, Term
from app.diagnosis.static.noise import known_noise, position_rms
from app.diagnosis.static.plain import plain_fit
from app.diagnosis.static.reading import renumbered
from app.diagnosis.static.recording import StaticRecording
from app.diagnosis.static.robust import outlier_rows
from app.errors import TeachframeError
from app.kinematics import RobotModel
from app.units import from_mm

#: Misfit [m] from which conventions are tried out, and how many noise levels it must be.
GROSS = from_mm(2.0)
GROSS_SIGMA = 20.0
#: Misfit [m] beyond which names are only given to what explains nearly all of it.
HOPELESS = from_mm(20.0)
_MOST = 2
_ALIKE = 1.5
#: Two misfits that differ by less than this share are the same.
_TIE = 0.02
#: Share of its spread that every joint keeps when rows are set aside.
_STILL_MOVES = 0.8


@dataclass(frozen=True, eq=False)
class Rewritten:
    """The recording as it should have been written, and what was wrong with it.

    Args:
        found: conventions undone, in order, each with those that would do as well.
        before: the plain fit to the recording as it was written; None where nothing was undone.
        plain: the plain fit to `recording`.
    """

    recording: StaticRecording
    found: tuple[tuple[Convention, tuple[Convention, ...]], ...]
    before: Fitted | None
    plain: Fitted


def rewritten(recording: StaticRecording, robot: RobotModel, held: tuple[Term, ...]) -> Rewritten:
    """Undoes wrong conventions, the one that helps most first, as long as each takes most of the misfit away."""
    found: list[tuple[Convention, tuple[Convention, ...]]] = []
    first = plain = plain_fit(recording, held)
    for _ in range(_MOST):
        if _misfit(plain) < GROSS:
            break  # without its strays it fits better still
        before = _misfit(_without_strays(recording, held))
        sigma = known_noise(recording).sigma
        if before < GROSS or (sigma is not None and before < GROSS_SIGMA * sigma):
            break
        tried = []
        for convention in conventions(recording):
            try:
                trial = _without_strays(convention.undone(recording, robot), held)
            except (TeachframeError, np.linalg.LinAlgError):
                continue
            tried.append((_scaled_misfit(trial, recording), convention))
        tried.sort(key=lambda pair: pair[0])
        if not tried or tried[0][0] > FALL * before:
            break
        chosen = likeliest(tried)
        alike = tuple(c for rms, c in tried if c is not chosen and rms < _ALIKE * tried[0][0])
        found.append((chosen, alike))
        recording = chosen.undone(recording, robot)
        plain = plain_fit(recording, held)
    return Rewritten(recording, tuple(found), first if found else None, plain)


def _without_strays(recording: StaticRecording, held: tuple[Term, ...]) -> Fitted:
    """A quick fit to the rows that belong together: a few wrong rows would hide which convention is right."""
    fitted = plain_fit(recording, held, quick=True)
    for _ in range(2):
        out = outlier_rows(fitted)
        # Rows in which alone a joint moves are no strays: without them its sign would be anybody's guess.
        moved = np.std(recording.q[~out], axis=0) if not out.all() else np.zeros(recording.q.shape[1])
        if not out.any() or np.any(moved < _STILL_MOVES * np.std(recording.q, axis=0)):
            break
        recording = renumbered(recording.subset(~out))
        fitted = plain_fit(recording, held, quick=True)
    return fitted


def likeliest(tried: list[tuple[float, Convention]]) -> Convention:
    """The convention that leaves least; among those that leave the same, the one people mix up most.

    A joint that counts the other way round and its neighbour's zero half a turn away are the very same motion.
    """
    level = (1.0 + _TIE) * min(rms for rms, _ in tried)
    ties = [convention for rms, convention in tried if rms <= level]
    return min(ties, key=lambda convention: LIKELIHOOD.index(convention.place.fixed["kind"]))


def _misfit(fitted: Fitted) -> float:
    return position_rms(fitted, corrected=False)


def _scaled_misfit(fitted: Fitted, original: StaticRecording) -> float:
    """A misfit in the units as they should be is compared with one in the units as written."""
    rms = _misfit(fitted)
    moved = fitted.recording.points is not original.points or fitted.recording.lengths is not original.lengths
    if moved:  # lengths in another unit: smaller both by the instrument's measure and by the arm's
        ratio = _spread(original.points, original.lengths) / _spread(
            fitted.recording.points, fitted.recording.lengths
        )
        rms *= max(ratio, 1.0)
    chain = original.situation.chain  # angles that hardly move fit anything
    travel = [
        np.std(chain.frames(q).flange_positions, axis=0).max() for q in (original.q, fitted.recording.q)
    ]
    rms *= max(float(travel[0] / max(travel[1], 1e-12)), 1.0)
    if original.orientations is not None:
        angular = fitted.recording.angular
        turn = float(np.sqrt(np.mean(fitted.residual[:, angular] ** 2)))
        rms = float(np.hypot(rms, 0.3 * turn))
    return rms


def _spread(points: np.ndarray | None, lengths: np.ndarray | None) -> float:
    values = points if points is not None else lengths
    return float(max(np.nanstd(values), 1e-12)) if values is not None else 1.0
