"""A saved model's effects into an arm of simulators; what none of them has a place for is left over with its size."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from app.diagnosis.corrected import GEOMETRIC, save_corrected_urdf
from app.diagnosis.effects.dynamic._friction import WIDTH
from app.diagnosis.export.arm import Left, SimArm, SimJoint
from app.diagnosis.export.physical import physical
from app.diagnosis.model import ModelEffect, SavedModel
from app.kinematics import RobotModel, load_robot
from app.kinematics.description.address import address_of
from app.kinematics.dynamics import PER_LINK, flange_to_last_link, inertial_parameters, point_mass
from app.kinematics.robot import GRAVITY

#: Speed over the width at which tanh lacks a hundredth.
_HUNDREDTH = 2.65
_INERTIAL = ("mass", "mx", "my", "mz", "ixx", "ixy", "iyy", "ixz", "iyz", "izz")
#: Law of a joint -> field of SimJoint and the parameter that is added to it.
_OF_JOINT = {
    "viscous_friction": (("damping", "viscous"),),
    "quadratic_friction": (("damping2", "quadratic"),),
    "coulomb_friction": (("friction", "coulomb"),),
    "rotor_inertia": (("armature", "inertia"),),
    "joint_spring": (("stiffness", "stiffness"), ("offset", "offset")),
    "friction_asymmetry": (("offset", "offset"),),
}


def carried(robot: RobotModel, model: SavedModel) -> SimArm:
    """The arm with everything in it that a rigid-body simulator has a place for."""
    geometry = [e for e in model.effects if e.effect in GEOMETRIC]
    built, lost = _with_geometry(robot, model, geometry)
    arm = _bare(built, model)
    left = list(lost)
    for effect in model.effects:
        if effect.effect in GEOMETRIC:
            continue
        put = _PUT.get(effect.effect, _put_joint if effect.effect in _OF_JOINT else None)
        after = put(arm, effect) if put is not None and not _passing(effect) else None
        if after is None:
            left.append(left_of(effect))
        else:
            arm = after
            left += _turn(effect)
    arm = _all_physical(arm, left)
    return replace(arm, left=tuple(left))


def left_of(effect: ModelEffect, why: str = "") -> Left:
    """An effect as one line: its place, its values."""
    place = ", ".join(f"{k} {v}" for k, v in effect.where.items())
    size = ", ".join(f"{k} {v:.4g}" for k, v in effect.parameters.items()) or "no values"
    return Left(f"{effect.effect} ({place})" if place else effect.effect, size, why)


def _turn(effect: ModelEffect) -> list[Left]:
    """Over which speed dry friction changes its sign: simulators change it at once, or over a speed of their own."""
    width, most = effect.parameters.get(WIDTH, 0.0), effect.parameters.get("coulomb", 0.0)
    if effect.effect != "coulomb_friction" or not width:
        return []
    what = f"the turn of dry friction (joint {effect.where.get('joint')})"
    why = f"there it has its full size at once: up to {abs(most):.3g} more, 1% of that at {_HUNDREDTH * width:.3g}"
    return [Left(what, f"over a speed of {width:.3g}", why)]


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


def _put_joint(arm: SimArm, effect: ModelEffect) -> SimArm | None:
    k, changes = int(effect.where["joint"]) - 1, {}
    for field, parameter in _OF_JOINT[effect.effect]:
        changes[field] = getattr(arm.joints[k], field) + effect.parameters.get(parameter, 0.0)
    if (
        changes.get("friction", 0.0) < 0.0
    ):  # what a fit may find where a model is not complete, no simulator takes
        return None
    return _joint(arm, k, changes)


def _joint(arm: SimArm, k: int, changes: dict[str, Any]) -> SimArm:
    joints = list(arm.joints)
    joints[k] = replace(joints[k], **changes)
    return replace(arm, joints=tuple(joints))


def _put_link(arm: SimArm, effect: ModelEffect) -> SimArm | None:
    k = int(effect.where["link"]) - 1
    change = np.array([effect.parameters.get(name, 0.0) for name in _INERTIAL])
    return _joint(arm, k, {"inertial": arm.joints[k].inertial + change})


def _put_payload(arm: SimArm, effect: ModelEffect) -> SimArm | None:
    p = effect.parameters
    if not {"mass", "com_x", "com_y", "com_z"} <= set(p):
        return None
    body = point_mass(p["mass"], np.array([p["com_x"], p["com_y"], p["com_z"]]))
    body[4:] += [p.get(f"fixed_{name}", 0.0) for name in _INERTIAL[4:]]  # about its centre, fitted along
    if "link" in effect.where:
        k = int(effect.where["link"]) - 1
        return _joint(arm, k, {"inertial": arm.joints[k].inertial + body})
    return replace(arm, payload=arm.payload + body)


def _put_gravity(arm: SimArm, effect: ModelEffect) -> SimArm | None:
    try:
        return replace(arm, gravity=np.array([effect.parameters[k] for k in ("gx", "gy", "gz")]))
    except KeyError:
        return None


def _put_delay(arm: SimArm, effect: ModelEffect) -> SimArm | None:
    if "joint" in effect.where or "delay" not in effect.parameters:
        return None
    return replace(arm, delay=arm.delay + effect.parameters["delay"])


def _put_gain(arm: SimArm, effect: ModelEffect) -> SimArm | None:
    scale = effect.parameters.get("scale")
    if scale is None or scale <= -1.0:
        return None
    chosen = [int(effect.where["joint"]) - 1] if "joint" in effect.where else range(len(arm.joints))
    for k in chosen:
        arm = _joint(arm, k, {"gain": arm.joints[k].gain * (1.0 + scale)})
    return arm


_PUT: dict[str, Callable[[SimArm, ModelEffect], SimArm | None]] = {
    "link_inertia": _put_link,
    "payload": _put_payload,
    "gravity_direction": _put_gravity,
    "delay": _put_delay,
    "torque_constant": _put_gain,
}


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
