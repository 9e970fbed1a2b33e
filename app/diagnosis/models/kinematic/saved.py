"""Terms to a saved model and back."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable

import numpy as np
from scipy.spatial.distance import cdist

from app.diagnosis.effects.effect import Place
from app.diagnosis.model import ModelEffect, SavedModel, Taught
from app.diagnosis.models.kinematic.setup import Setup
from app.diagnosis.models.kinematic.situation import Situation
from app.diagnosis.models.kinematic.terms import Term, effects
from app.diagnosis.observations.conventions import Convention
from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.thresholds.drivers import ALIKE, NEAREST
from app.errors import UnknownNameError
from app.kinematics import RobotModel

_FIXED = "fixed_"  # prefix of parameters that choose a law's form
#: rad or m: a joint whose range is smaller was never moved.
_STILL = 1e-3
#: Poses kept to say where a model was learnt.
_POSES = 100


def model_effects(situation: Situation, terms: Iterable[Term]) -> tuple[ModelEffect, ...]:
    """Terms as data."""
    out = []
    for term in terms:
        quantities = term.effect.quantities(situation, term.place)
        parameters = {q.name: float(v) for q, v in zip(quantities, term.values, strict=True)}
        parameters |= {_FIXED + name: float(value) for name, value in term.place.fixed.items()}
        fades, along = term.reach is not None, _along(term.reach)
        out.append(
            ModelEffect(term.effect.key, dict(term.where), parameters, term.named, fades, along, term.near)
        )
    return tuple(out)


def _along(reach: np.ndarray | None) -> int:
    """The joint (from 1) that a reach (2, n) is about alone; 0 for all."""
    if reach is None:
        return 0
    bounded = np.flatnonzero(np.isfinite(reach).all(axis=0))
    return int(bounded[0]) + 1 if len(bounded) == 1 < reach.shape[1] else 0


def convention_effects(conventions: Iterable[Convention]) -> tuple[ModelEffect, ...]:
    """Conventions that were undone, as data."""
    key = next(e.key for e in effects().values() if e.undone)
    return tuple(
        ModelEffect(key, dict(c.place.where), {_FIXED + n: float(v) for n, v in c.place.fixed.items()})
        for c in conventions
    )


def setup_numbers(setup: Setup) -> dict[str, list[float]]:
    """Base, tool and touched points of the recording [m], rotations row by row."""
    return {
        "rotations": setup.rotations.reshape(-1).tolist(),
        "positions": setup.positions.reshape(-1).tolist(),
        "tools": setup.tools.reshape(-1).tolist(),
        "targets": setup.targets.reshape(-1).tolist(),
    }


def fingerprint(recording: StaticRecording) -> str:
    """Of the rows: equal for the same angles and measurements, whatever the file is called."""
    measured = recording.points if recording.points is not None else recording.lengths
    parts = [recording.q, recording.target.astype(float)] + ([] if measured is None else [measured])
    return hashlib.sha256(b"".join(np.ascontiguousarray(p).tobytes() for p in parts)).hexdigest()[:16]


def taught_by(recording: StaticRecording) -> Taught:
    """Where a model was learnt; its held-out error [mm] is known once the model was judged."""
    q = recording.q
    low, high = q.min(axis=0), q.max(axis=0)
    chosen = np.unique(np.linspace(0, len(q) - 1, min(_POSES, len(q))).astype(int))
    return Taught(
        lowest=low.tolist(),
        highest=high.tolist(),
        still=[int(j) + 1 for j in np.flatnonzero(high - low < _STILL)],
        poses=np.round(q[chosen], 6).tolist(),
        rows=fingerprint(recording),
        unit="mm",
    )


def held_terms(model: SavedModel, situation: Situation, rows: str = "") -> tuple[Term, ...]:
    """A saved model's effects as terms for this situation.

    Events of a recording (steps, drifts) belong to the rows they were found in and are left out elsewhere; they shift
    what every other recording fits anew. What an instrument gets wrong throughout (its zero, its scale) is carried: no
    base takes it up, and whoever measures an arm again mostly does so with the same instrument.

    Args:
        rows: fingerprint of these rows; empty for none in particular.

    Raises:
        UnknownNameError: an effect or parameter this program does not have.
    """
    out = []
    known = effects()
    own = bool(rows) and rows == model.taught.rows
    alike = own or not any(entry.near for entry in model.effects) or _alike(model.taught, situation.q)
    for entry in model.effects:
        if entry.effect not in known:
            raise UnknownNameError(entry.effect, available=known, what="static effect in the saved model")
        effect = known[entry.effect]
        if entry.near and not alike:
            continue
        if effect.undone or not (effect.lasts(entry.where) or own or not model.taught.rows):
            continue
        fixed = {k[len(_FIXED) :]: v for k, v in entry.parameters.items() if k.startswith(_FIXED)}
        place = Place(dict(entry.where), fixed, scan="from_row" in entry.where)
        names = [q.name for q in effect.quantities(situation, place)]
        missing = [name for name in names if name not in entry.parameters]
        if missing:
            raise UnknownNameError(
                missing[0], available=entry.parameters, what=f"parameter of {entry.effect}"
            )
        values = np.array([entry.parameters[n] for n in names], float)
        out.append(Term(effect, place, values, entry.named, _reach(model.taught, entry)))
    return tuple(out)


def _alike(taught: Taught, q: np.ndarray) -> bool:
    """Whether poses q (m, n) lie among those taught, each joint measured by how far it was moved there."""
    poses = np.array(taught.poses)
    scale = np.maximum(poses.std(axis=0), _STILL)
    between = cdist(poses / scale, poses / scale)
    np.fill_diagonal(between, np.inf)
    near = np.quantile(between.min(axis=1), NEAREST)
    return bool(np.mean(cdist(q / scale, poses / scale).min(axis=1) <= near) >= ALIKE)


def _reach(taught: Taught, entry: ModelEffect) -> np.ndarray | None:
    """(2, n) between which joint positions an effect holds; None where it holds everywhere."""
    return reach_of(np.array([taught.lowest, taught.highest]), entry.along) if entry.fades else None


def reach_of(ranges: np.ndarray, along: int) -> np.ndarray:
    """(2, n) lowest and highest joint positions of a recording; where one joint counts alone, the others are free.

    Args:
        along: that joint, from 1; 0 for all.
    """
    if not along:
        return ranges
    own = np.tile([[-np.inf], [np.inf]], ranges.shape[1])
    own[:, along - 1] = ranges[:, along - 1]
    return own


def undone(model: SavedModel, recording: StaticRecording, robot: RobotModel) -> StaticRecording:
    """The recording with the conventions undone that a saved model holds."""
    known = effects()
    for entry in model.effects:
        if entry.effect in known and known[entry.effect].undone:
            fixed = {k[len(_FIXED) :]: v for k, v in entry.parameters.items() if k.startswith(_FIXED)}
            recording = Convention(Place(dict(entry.where), fixed)).undone(recording, robot)
    return recording
