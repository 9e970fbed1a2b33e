"""How the recording was written down: conventions of the whole recording, each by its evidence."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.kinematic.timing import delays
from app.diagnosis.models.kinematic.candidates import library_of
from app.diagnosis.models.kinematic.library import linearised
from app.diagnosis.models.kinematic.rows import compared, t_likelihood, weighted_anew
from app.diagnosis.observations.conventions import Convention, conventions, delayed, likelihood_of
from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.observations.pose_reading import renumbered
from app.diagnosis.regression.evidence import Evidence
from app.diagnosis.thresholds.conventions import (
    ALIKE,
    BESIDE,
    CONVENTION,
    CONVENTION_MISFIT,
    CONVENTION_ROWS,
    CONVENTIONS,
)
from app.errors import TeachframeError
from app.kinematics import RobotModel

if TYPE_CHECKING:
    from app.diagnosis.models.kinematic.state import State


#: Hypotheses that go from the plain comparison to the one with all families in.
_SHORT_LIST = 4
#: Gauss-Newton steps that tell a gross misfit from a small one.
_STEPS = 4


@dataclass(frozen=True, eq=False)
class Written:
    """The recording as it should have been written.

    Args:
        recording: conventions undone.
        found: what was undone, in order, each with those that would do as well.
    """

    recording: StaticRecording
    found: tuple[tuple[Convention, tuple[Convention, ...]], ...]


def rewritten(recording: StaticRecording, robot: RobotModel) -> Written:
    """Undoes wrong conventions, one at a time, as long as one earns its place against an arm off everywhere."""
    found: list[tuple[Convention, tuple[Convention, ...]]] = []
    for _ in range(CONVENTIONS):
        keep = _thinned(recording)
        sample = _some(recording, keep)
        plain = _fitted(sample)
        if plain is None or plain.misfit < CONVENTION_MISFIT:
            break
        chosen = _best(recording, keep, plain, robot)
        if chosen is None:
            break
        found.append(chosen)
        recording = chosen[0].undone(recording, robot)
    return Written(recording, tuple(found))


def _best(
    recording: StaticRecording, keep: np.ndarray, plain: State, robot: RobotModel
) -> tuple[Convention, tuple[Convention, ...]] | None:
    """The convention with the highest evidence, and those that explain the same; None where none earns its place."""
    sample = plain.recording
    tried: list[tuple[float, Convention]] = []
    as_written = _likelihood(plain, sample)

    def placed(convention: Convention) -> State | None:
        apart = convention.needs_neighbours
        return _fitted(_some(convention.placed(recording), keep) if apart else convention.placed(sample))

    def likelihood(seconds: float, even: float) -> float:
        state = placed(delayed(seconds, even))
        return -np.inf if state is None else _likelihood(state, sample)

    on_the_move = bool(recording.situation.speed.any()) and recording.session_count == 1
    times = delays(recording.situation.time, likelihood) if on_the_move else ()
    others = conventions(sample, in_seconds=on_the_move)
    for convention in (*others, *(delayed(*found) for found in times)):
        state = placed(convention)
        if state is None or (convention.needs_neighbours and state.misfit > BESIDE * plain.misfit):
            continue
        gain = _likelihood(state, sample) - as_written
        if gain > CONVENTION:
            tried.append((gain, convention))
    tried.sort(key=lambda entry: -entry[0])
    if not tried:
        return None
    as_is = _evidence(plain, sample)
    short = [
        (convention, _plain_of(convention, recording, keep, robot)) for _, convention in tried[:_SHORT_LIST]
    ]
    scored = [
        (_evidence(state, sample) - as_is, convention) for convention, state in short if state is not None
    ]
    top = max(gain for gain, _ in scored)
    # Alone, one of several wrong conventions may not earn its place against families that bend to it: then the plain
    # comparison, which is cruder and harder to please, decides.
    if top < CONVENTION and tried[0][0] < 10.0 * CONVENTION:
        return None
    alike = [c for gain, c in scored if gain > top - ALIKE]
    alike.sort(key=likelihood_of)
    return alike[0], tuple(alike[1:])


def _plain_of(
    convention: Convention, recording: StaticRecording, keep: np.ndarray, robot: RobotModel
) -> State | None:
    try:
        if convention.needs_neighbours:
            return _fitted(_some(convention.undone(recording, robot), keep))
        return _fitted(convention.undone(_some(recording, keep), robot))
    except (TeachframeError, np.linalg.LinAlgError):
        return None


def _fitted(recording: StaticRecording) -> State | None:
    """Base, tool and touched points, well enough to tell a gross misfit from a small one."""
    return compared(recording, (), _STEPS)


def _likelihood(state: State, original: StaticRecording) -> float:
    """Log likelihood of the rows under a multivariate t, lengths in the recording's own unit [nats]."""
    here = state.recording
    unit = _unit_ratio(here, original) * _travel_ratio(here, original)
    return t_likelihood(here, state.residual, 0.0, unit)


def _unit_ratio(here: StaticRecording, original: StaticRecording) -> float:
    """How many of the recording's own lengths one of the rewritten ones is."""
    a, b = _lengths(original), _lengths(here)
    return 1.0 if a is b or not len(a) else max(float(np.nanstd(a) / max(np.nanstd(b), 1e-12)), 1.0)


def _lengths(recording: StaticRecording) -> np.ndarray:
    if recording.points is not None:
        return recording.points
    return np.zeros(0) if recording.lengths is None else recording.lengths


def _travel_ratio(here: StaticRecording, original: StaticRecording) -> float:
    """Angles that hardly move fit anything: a smaller travel counts against a convention."""
    if here.q is original.q:
        return 1.0
    return max(_travel(original) / max(_travel(here), 1e-12), 1.0)


def _travel(recording: StaticRecording) -> float:
    """m by which the flange spreads along its longest axis (one sigma)."""
    situation = recording.situation
    if ("travel",) not in situation.kept:
        flange = situation.chain.frames(situation.q).flange_positions
        situation.kept[("travel",)] = float(np.std(flange, axis=0).max())
    return situation.kept[("travel",)]


def _evidence(state: State, original: StaticRecording) -> float:
    """Log evidence with zeros, geometry and elasticity free in their nominal sizes, in the recording's own unit."""
    now, residual, occam = state, state.residual, 0.0
    for _ in range(2):
        linear = linearised(
            replace(now, terms=()), library_of(now.recording.situation), (Level.CALIBRATION,), set()
        )
        evidence = Evidence(linear.design, linear.groups)
        families = {g: 1.0 for g, group in enumerate(linear.groups) if isinstance(group.label, str)}
        selection = evidence.tuned(families, 1)
        posterior = evidence.posterior(selection)
        left = linear.design.left(posterior.columns, posterior.weights)
        residual = np.where(
            now.weights > 0,
            left.reshape(now.weights.shape) / np.where(now.weights > 0, now.weights, 1.0),
            0.0,
        )
        occam = evidence.factor(selection).occam
        weights, _ = weighted_anew(replace(now, residual=residual), linear.design.free_count)
        now = replace(now, weights=weights)
    return _likelihood(replace(now, residual=residual), original) - occam


def _some(recording: StaticRecording, keep: np.ndarray) -> StaticRecording:
    """Rows (m,) of a recording, numbered anew; all of them as they are."""
    return recording if keep.all() else renumbered(recording.subset(keep))


def _thinned(recording: StaticRecording) -> np.ndarray:
    """(m,) True for rows spread over the recording; touched points keep at least two rows."""
    if recording.size <= CONVENTION_ROWS:
        return np.ones(recording.size, bool)
    keep = np.zeros(recording.size, bool)
    if recording.mode == "targets":
        step = -(-recording.size // CONVENTION_ROWS)
        keep[np.isin(recording.target, np.unique(recording.target)[::step])] = True
    if keep.sum() < CONVENTION_ROWS // 2:
        keep[np.unique(np.linspace(0, recording.size - 1, CONVENTION_ROWS).astype(int))] = True
    # a joint that moves in few rows only keeps them: without them its sign would be anybody's guess
    still = recording.q[keep].std(axis=0) < 0.8 * recording.q.std(axis=0)
    for j in np.flatnonzero(still):
        far = np.argsort(-np.abs(recording.q[:, j] - np.median(recording.q[:, j])))[:10]
        keep[far] = True
    if recording.mode == "targets":
        count = np.bincount(recording.target[keep], minlength=len(recording.target_names))
        keep &= count[recording.target] >= 2
    return keep
