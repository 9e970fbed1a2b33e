"""Terms to a saved model and back."""

from __future__ import annotations

import numpy as np

from app.diagnosis.model import ModelEffect, SavedModel
from app.diagnosis.static.conventions import Convention
from app.diagnosis.static.effect import Place
from app.diagnosis.static.fit import Fitted, Term
from app.diagnosis.static.gross import Rewritten
from app.diagnosis.static.library import effects
from app.diagnosis.static.recording import StaticRecording
from app.diagnosis.static.situation import Situation
from app.errors import UnknownNameError
from app.kinematics import RobotModel

CONVENTION = "wrong_convention"
_FIXED = "fixed_"  # prefix of parameters that choose a law's form


def saved_model(
    fitted: Fitted, robot: str, source: str, written: Rewritten, spoken: set[int] | None = None
) -> SavedModel:
    """Everything found, in SI, geometry that was only fitted alongside included.

    Args:
        spoken: ids of the only terms to be kept; None keeps all.
    """
    out = []
    for convention, _ in written.found:
        fixed = {_FIXED + name: float(value) for name, value in convention.place.fixed.items()}
        out.append(ModelEffect(CONVENTION, dict(convention.place.where), fixed))
    for term in (*fitted.held, *fitted.terms):
        if term.effect.key not in effects():
            continue  # a curve without a name is no model
        if spoken is not None and term not in fitted.held and id(term) not in spoken:
            continue
        quantities = term.effect.quantities(fitted.recording.situation, term.place)
        parameters = {q.name: float(v) for q, v in zip(quantities, term.values, strict=True)}
        parameters |= {_FIXED + name: float(value) for name, value in term.place.fixed.items()}
        out.append(ModelEffect(term.effect.key, dict(term.where), parameters))
    setup = fitted.setup
    nuisance = {
        "rotations": setup.rotations.reshape(-1).tolist(),
        "positions": setup.positions.reshape(-1).tolist(),
        "tools": setup.tools.reshape(-1).tolist(),
        "targets": setup.targets.reshape(-1).tolist(),
    }
    return SavedModel("static", robot, tuple(out), nuisance, source)


def held_terms(model: SavedModel, situation: Situation, file: str = "") -> tuple[Term, ...]:
    """A saved model's effects as terms for this situation.

    A step belongs to the rows of the recording it was found in; in any other it has happened before the first.

    Args:
        file: the recording these rows are from.

    Raises:
        UnknownNameError: an effect or parameter this program does not have.
    """
    out = []
    for entry in model.effects:
        known = effects()
        if entry.effect == CONVENTION:
            continue  # undone in the recording itself
        if entry.effect not in known:
            raise UnknownNameError(entry.effect, available=known, what="static effect in the saved model")
        effect = known[entry.effect]
        fixed = {k[len(_FIXED) :]: v for k, v in entry.parameters.items() if k.startswith(_FIXED)}
        where = dict(entry.where)
        if "from_row" in where and file != model.source:
            where["from_row"] = 1
        place = Place(where, fixed, scan="from_row" in where)
        names = [q.name for q in effect.quantities(situation, place)]
        missing = [name for name in names if name not in entry.parameters]
        if missing:
            raise UnknownNameError(
                missing[0], available=entry.parameters, what=f"parameter of {entry.effect}"
            )
        out.append(Term(effect, place, np.array([entry.parameters[name] for name in names])))
    return tuple(out)


def undone(model: SavedModel, recording: StaticRecording, robot: RobotModel) -> StaticRecording:
    """The recording with the conventions undone that a saved model holds."""
    for entry in model.effects:
        if entry.effect == CONVENTION:
            fixed = {k[len(_FIXED) :]: v for k, v in entry.parameters.items() if k.startswith(_FIXED)}
            recording = Convention(Place(dict(entry.where), fixed)).undone(recording, robot)
    return recording
