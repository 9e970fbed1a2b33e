"""What was found goes into the simulation that people use: one file a target under targets/, found by its `TARGET`.

    arm.py        an arm as simulators describe it: bodies, joints, what acts on them, actuators
    carrying.py   a saved model's effects into such an arm; what no simulator has a place for is left over
    physical.py   masses that no body can have -> the nearest that one can
    targets/      urdf, mjcf, sdf, usd

Each target says which version it writes, and lists what it cannot carry, with its size, in the file itself too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, cast

from app import catalog
from app.diagnosis.export.arm import Left, SimArm
from app.diagnosis.export.carrying import carried
from app.diagnosis.model import SavedModel
from app.diagnosis.model_checks import fitting
from app.kinematics import RobotModel

__all__ = ["Exported", "Target", "export_model", "target", "targets"]

TARGETS = "app.diagnosis.export.targets"


class Target(Protocol):
    """A file under targets/ with an object `TARGET` of this shape is a target."""

    key: str
    title: str
    version: str
    suffix: str

    def write(self, arm: SimArm) -> tuple[str, tuple[Left, ...]]:
        """The file's text, and what of the arm it has no place for."""
        ...


@dataclass(frozen=True)
class Exported:
    """A written model.

    Args:
        text: the file.
        version: what it is written for.
        left: what it does not carry, with its size.
    """

    text: str
    version: str
    left: tuple[Left, ...]


def targets() -> dict[str, Target]:
    """All targets by key."""
    return catalog.members(TARGETS, "TARGET")


def target(key: str) -> Target:
    """One target; raises UnknownNameError."""
    return cast(Target, catalog.member(TARGETS, "TARGET", key, what="target"))


def export_model(robot: RobotModel, model: SavedModel, key: str) -> Exported:
    """The robot with the model in it, as a simulator reads it.

    Raises:
        UnknownNameError: no such target.
        InputError: the model does not fit the robot.
    """
    form = target(key)
    arm = carried(robot, fitting(model, robot))
    text, left = form.write(arm)
    return Exported(text, f"{form.title}, {form.version}", (*arm.left, *left))
