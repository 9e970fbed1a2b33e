"""A saved model's effects as terms of the generator: what a diagnosis found is simulated by other code."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from app import catalog
from app.diagnosis.dispatch import family
from app.diagnosis.model import ModelEffect, SavedModel
from app.diagnosis.observations.conventions import QUARTER, SIGN, SWAP
from app.errors import InputError, UnknownNameError
from app.kinematics import load_robot
from app.proof.generator.effects.term import Term
from app.proof.generator.motion.cell import LAWS as MOTION_LAWS
from app.proof.generator.static.cell import LAWS as STATIC_LAWS

#: Parts of a saved model that describe one recording, or have no law: none of an arm that is made anew.
NOT_DRAWN = frozenset({"smooth_torque", "rest_friction"})
_FIXED = "fixed_"  # how a saved model marks values that choose a law's form
_COUNTED = ("joint", "source_joint", "link")
#: Kind of recording -> the effect that only the other kind has.
_NEEDED = {"touch": "instrument_zero_shift", "tracker": "touch_indentation"}


def terms_of(
    model: SavedModel,
    kind: str,
    robot: str,
    *,
    samples: int,
    seconds: float = 0.0,
    file: str | Path | None = None,
) -> tuple[tuple[Term, ...], tuple[str, ...]]:
    """What the simulation puts into its cell.

    A step happens at the row it was found at, so that the recording is one like that the model was learnt from.

    Args:
        kind: of the recording to be made: touch, tracker or motion.
        robot: the arm's address.
        samples: rows that are made.
        seconds: length of the log (motion).
        file: the model's file, for messages.

    Returns:
        The terms, and one line for each effect that this recording cannot carry.

    Raises:
        InputError: a model of another kind of recording or of another arm.
        UnknownNameError: an effect nobody knows.
    """
    if model.kind != family(kind):
        raise InputError(
            f"the model was learnt from {model.kind} recordings",
            file=file,
            expected=f"--kind of {model.kind}",
        )
    laws = catalog.members(MOTION_LAWS if model.kind == "motion" else STATIC_LAWS, "EFFECT")
    joints = load_robot(robot).joint_count
    terms: list[Term] = []
    left_out: list[str] = []
    for effect in model.effects:
        if effect.effect in NOT_DRAWN:
            left_out.append(f"left out of the simulation: {effect.effect} (no law that the simulation draws)")
            continue
        if effect.effect not in laws:
            raise UnknownNameError(
                effect.effect, available=laws, what=f"{model.kind} effect in the saved model", file=file
            )
        beyond = [k for k in _COUNTED if int(effect.where.get(k, 1)) > joints]
        if beyond:
            raise InputError(
                f"{effect.effect} sits at {beyond[0]} {effect.where[beyond[0]]}, and {robot} has {joints} joints",
                file=file,
                expected=f"a model of this arm; it was learnt on {model.robot}",
            )
        why = _impossible(effect, kind, samples, seconds)
        if why:
            left_out.append(f"left out of the simulation: {effect.effect} ({why})")
        else:
            terms.append(_term(effect))
    return tuple(terms), tuple(left_out)


def _impossible(effect: ModelEffect, kind: str, samples: int, seconds: float) -> str:
    """Why a recording of this kind and length cannot carry the effect; empty where it can."""
    where = effect.where
    if where.get("driver") == "temperature" or "per_degree" in effect.parameters:
        return "no temperature is simulated"
    if int(where.get("from_row", 1)) > samples:
        return f"it begins at row {where['from_row']} of {samples}"
    if kind == "motion" and float(where.get("from_s", 0.0)) >= seconds:
        return f"it begins after {where['from_s']:g} s, the log ends at {seconds:g} s"
    if "resonance" in effect.parameters:
        return "learnt without masses, it has a resonance and no stiffness"
    if kind in _NEEDED and effect.effect == _NEEDED[kind]:
        return f"a {kind} recording cannot show it"
    if effect.effect == "wrong_convention" and effect.parameters.get(_FIXED + "kind") not in (
        SIGN, QUARTER, SWAP,
    ):  # fmt: skip
        return "a unit or an inverse is a matter of the file"
    return ""


def _term(effect: ModelEffect) -> Term:
    where: dict[str, Any] = dict(effect.where)
    values = {k: float(v) for k, v in effect.parameters.items() if not k.startswith(_FIXED)}
    if effect.effect == "wrong_convention":
        fixed = {k.removeprefix(_FIXED): v for k, v in effect.parameters.items()}
        where = {"joint": int(fixed["joint"])}
        if fixed["kind"] == SWAP:
            where["source_joint"] = int(fixed["other"])
        values = {"turn": float(fixed["turn"])} if fixed["kind"] == QUARTER else {}
    if effect.effect in ("payload", "payload_change"):
        mass = values["mass"]
        for axis in "xyz":
            moment = values.pop(f"moment_{axis}", 0.0)
            values.setdefault(f"com_{axis}", moment / mass if mass else 0.0)
    return Term(effect.effect, where, values, scalable=False)
