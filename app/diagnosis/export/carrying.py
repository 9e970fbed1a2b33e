"""A saved model's effects into an arm of simulators; what none of them has a place for is left over with its size."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from app.diagnosis import effects
from app.diagnosis.corrected import save_corrected_urdf
from app.diagnosis.effects.described import Body, Change, Gain, Gravity, InJoint, Late, Masses, Placed
from app.diagnosis.export.arm import Left, SimArm, SimJoint
from app.diagnosis.export.physical import physical
from app.diagnosis.model import ModelEffect, SavedModel
from app.kinematics import RobotModel, load_robot
from app.kinematics.description.address import address_of
from app.kinematics.dynamics import PER_LINK, flange_to_last_link, inertial_parameters
from app.kinematics.robot import GRAVITY

#: Speed over the width at which tanh lacks a hundredth.
_HUNDREDTH = 2.65


def carried(robot: RobotModel, model: SavedModel) -> SimArm:
    """The arm with everything in it that a rigid-body simulator has a place for."""
    said = [(effect, _said(robot, model.kind, effect)) for effect in model.effects]
    built, lost = _with_geometry(robot, model, [effect for effect, changes in said if _moves(changes)])
    arm = _bare(built, model)
    left = list(lost)
    for effect, changes in said:
        if _moves(changes):
            continue
        after = _put(arm, changes) if changes and not _passing(effect) else None
        if after is None:
            left.append(left_of(effect, _lacking(model.kind, effect)))
        else:
            arm = after
            left += _turn(changes)
    arm = _all_physical(arm, left)
    return replace(arm, left=tuple(left))


def left_of(effect: ModelEffect, why: str = "") -> Left:
    """An effect as one line: its place, its values."""
    place = ", ".join(f"{k} {v}" for k, v in effect.where.items())
    size = ", ".join(f"{k} {v:.4g}" for k, v in effect.parameters.items()) or "no values"
    return Left(f"{effect.effect} ({place})" if place else effect.effect, size, why)


def _said(robot: RobotModel, kind: str, effect: ModelEffect) -> tuple[Change, ...]:
    """An effect in the words of a description; () where there are none for it."""
    law = effects.named(effect.effect, kind)
    return () if law is None else law.described(robot, effect.where, effect.parameters)


def _lacking(kind: str, effect: ModelEffect) -> str:
    """Why a description of rigid bodies has no words for it, where the effect says so."""
    law = effects.named(effect.effect, kind)
    return "" if law is None else law.no_words


def _moves(changes: tuple[Change, ...]) -> bool:
    return any(isinstance(change, Placed) for change in changes)


def _turn(changes: tuple[Change, ...]) -> list[Left]:
    """Over which speed dry friction changes its sign: simulators change it at once, or over a speed of their own."""
    out = []
    for change in changes:
        if isinstance(change, InJoint) and "friction" in change.more and change.turns_over:
            width, most = change.turns_over, abs(change.more["friction"])
            why = f"there it has its full size at once: up to {most:.3g} more, 1% of that at {_HUNDREDTH * width:.3g}"
            what = f"the turn of dry friction (joint {change.joint})"
            if change.turns_on:
                why = f"there it has its full size at once: up to {2.0 * most:.3g} more just after every turn"
                out.append(Left(what, f"on a way of {change.turns_on:.3g}", why))
                continue
            out.append(Left(what, f"over a speed of {width:.3g}", why))
    return out


def _passing(effect: ModelEffect) -> bool:
    """What happened at a time or a row belongs to the recording it was found in."""
    return any(key in effect.where for key in ("from_s", "to_s", "from_row"))


def _with_geometry(
    robot: RobotModel, model: SavedModel, effects: list[ModelEffect]
) -> tuple[RobotModel, tuple[Left, ...]]:
    """The description with zeros, lengths and twists in it, and those that could not be written."""
    if not effects:
        return robot, ()
    with TemporaryDirectory() as folder:
        path = Path(folder) / "arm.urdf"
        kept, lost = [], []
        for effect in effects:
            written = save_corrected_urdf(robot, replace_effects(model, (effect,)), path, strict=False)
            (lost if written else kept).append(effect)
        save_corrected_urdf(robot, replace_effects(model, tuple(kept)), path, strict=False)
        built = load_robot(str(address_of(str(path), chain=f"{robot.base}..{robot.flange}")))
    return (
        replace(built, name=robot.name, path=robot.path, description=robot.description),
        tuple(left_of(effect) for effect in lost),
    )


def replace_effects(model: SavedModel, effects: tuple[ModelEffect, ...]) -> SavedModel:
    """The same model with other effects."""
    return SavedModel(model.kind, model.robot, effects, {}, model.source)


def _bare(robot: RobotModel, model: SavedModel) -> SimArm:
    chain = robot.chain
    masses = inertial_parameters(robot).reshape(-1, PER_LINK)
    fitted = np.array(model.nuisance.get("inertial", ()), float)
    if fitted.size == masses.size:  # the whole fit's masses stand beside the findings
        masses = fitted.reshape(-1, PER_LINK)
    joints = tuple(
        SimJoint(
            name=joint.name,
            body=f"link_{k + 1}",
            rotation=chain.rotations[k],
            position=chain.translations[k],
            axis=chain.axes[k],
            prismatic=joint.prismatic,
            lower=joint.lower,
            upper=joint.upper,
            velocity=joint.velocity,
            effort=joint.effort,
            inertial=masses[k],
        )
        for k, joint in enumerate(robot.joints)
    )
    flange = (chain.flange_rotation, chain.flange_translation, robot.flange)
    return SimArm(robot, joints, flange, np.zeros(PER_LINK), GRAVITY.copy(), 0.0, (), model.source)


def _put(arm: SimArm, changes: tuple[Change, ...]) -> SimArm | None:
    """The arm with the changes in it; None where one of them is none that a simulator takes."""
    now: SimArm | None = arm
    for change in changes:
        now = now and _with(now, change)
    return now


def _with(arm: SimArm, change: Change) -> SimArm | None:
    match change:
        case InJoint(joint, more):
            own = arm.joints[joint - 1]
            changed = {word: getattr(own, word) + value for word, value in more.items()}
            if changed.get("friction", 0.0) < 0.0:  # what a fit may find where a model is not complete
                return None
            return _joint(arm, joint - 1, changed)
        case Masses(link, more):
            return _joint(arm, link - 1, {"inertial": arm.joints[link - 1].inertial + more})
        case Body(link=None):
            return replace(arm, payload=arm.payload + change.inertial)
        case Body(link=int(link)):
            return _joint(arm, link - 1, {"inertial": arm.joints[link - 1].inertial + change.inertial})
        case Gravity(vector):
            return replace(arm, gravity=vector)
        case Late(seconds):
            return replace(arm, delay=arm.delay + seconds)
        case Gain(factor, joint):
            for k in range(len(arm.joints)) if joint is None else [joint - 1]:
                arm = _joint(arm, k, {"gain": arm.joints[k].gain * factor})
            return arm
    return None


def _joint(arm: SimArm, k: int, changes: dict[str, Any]) -> SimArm:
    joints = list(arm.joints)
    joints[k] = replace(joints[k], **changes)
    return replace(arm, joints=tuple(joints))


def _all_physical(arm: SimArm, left: list[Left]) -> SimArm:
    """The load as part of the last body, and every body as one that can be; what that changed is told."""
    if arm.payload.any():
        last = len(arm.joints) - 1
        moved = flange_to_last_link(arm.robot) @ arm.payload
        arm = _joint(arm, last, {"inertial": arm.joints[last].inertial + moved})
    for k, joint in enumerate(arm.joints):
        near = physical(joint.inertial)
        if near is not joint.inertial:
            left.append(_moved(joint.body, joint.inertial, near))
            arm = _joint(arm, k, {"inertial": near})
    return arm


def _moved(body: str, was: np.ndarray, now: np.ndarray) -> Left:
    return Left(
        f"masses of {body} as fitted",
        f"mass by {now[0] - was[0]:+.3g} kg, first moment by {np.linalg.norm((now - was)[1:4]):.2g} kg m, "
        f"inertia by {np.abs((now - was)[4:]).max():.2g} kg m^2",
        "no body has them; the nearest that one can have are written",
    )
