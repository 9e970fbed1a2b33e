"""Arms: what a URDF says, where the flange is, how to get it somewhere. The only package that imports pin.

robot.py       RobotModel: forward kinematics, Jacobian, gravity torques, limits
description/   from the bytes of a file to the chain of joints that is the arm
loading.py     finds a robot by name or path and reads its description
chain.py       the arm as plain arrays, for many poses at once
inverse.py     damped inverse kinematics that says why it stopped
meshes.py      meshes of a person's own description, within its folder, made light
packing.py     a description as one light zip, to be kept
shapes.py      the solids a description draws its links with
solids.py      the same as convex hulls and meshes, to draw and to hit
collision.py   what the arm, its tool and its surroundings touch
contact.py     how far a carried thing is from a standing one
"""

import importlib
from typing import TYPE_CHECKING, Any

from app.kinematics.chain import Chain
from app.kinematics.loading import load_robot, makers_tables, robot_names
from app.kinematics.robot import Joint, RobotModel

if TYPE_CHECKING:
    from app.kinematics.collision import CollisionWorld, ContactPair
    from app.kinematics.contact import Contact
    from app.kinematics.inverse import IkResult, solve_ik

#: What few commands need and what costs as much to load as all the rest: coal, scipy.
_LATER = {
    "CollisionWorld": "collision",
    "ContactPair": "collision",
    "Contact": "contact",
    "IkResult": "inverse",
    "solve_ik": "inverse",
}

__all__ = [
    "Chain",
    "CollisionWorld",
    "Contact",
    "ContactPair",
    "IkResult",
    "Joint",
    "RobotModel",
    "load_robot",
    "makers_tables",
    "robot_names",
    "solve_ik",
]


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"app.kinematics.{_LATER[name]}"), name)
