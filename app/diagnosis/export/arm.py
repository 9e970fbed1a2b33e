"""An arm as simulators describe it: a chain of bodies, what acts in its joints, and what its actuators do.

SI units. The frame of a body is its joint's frame, which turns or slides with it, as in URDF.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.kinematics import RobotModel


@dataclass(frozen=True)
class Left:
    """Something that has no place in a target.

    Args:
        what: the effect and where it sits.
        size: its parameters with their values.
        why: what the target has instead, where it has something like it.
    """

    what: str
    size: str
    why: str = ""

    def __str__(self) -> str:
        return f"{self.what}: {self.size}" + (f" ({self.why})" if self.why else "")


@dataclass(frozen=True, eq=False)
class SimJoint:
    """A moving joint with the body behind it.

    Torque the drive gives = that of the rigid bodies + armature * qdd + damping * qd + damping2 * |qd| * qd
    + friction * sign(qd) + stiffness * q + offset.

    Args:
        name: of the joint; `body` is its link's.
        rotation, position: (3, 3), (3,) [m] of the joint's frame in the parent body at zero.
        axis: (3,) unit, in that frame.
        prismatic: True where it slides.
        lower, upper: limits [rad or m].
        velocity, effort: limits [rad/s or m/s, Nm or N]; 0 where none is stated.
        inertial: (10,) mass [kg], first moment [kg m], inertia xx xy yy xz yz zz about the frame [kg m^2].
        armature: inertia of the rotor seen through the gear [kg m^2 or kg].
        damping, damping2: [Nm s/rad], [Nm s^2/rad^2].
        friction: dry friction [Nm or N].
        stiffness, offset: of a spring [Nm/rad], and constant torque [Nm].
        gain: recorded torque over true torque.
    """

    name: str
    body: str
    rotation: np.ndarray
    position: np.ndarray
    axis: np.ndarray
    prismatic: bool
    lower: float
    upper: float
    velocity: float
    effort: float
    inertial: np.ndarray
    armature: float = 0.0
    damping: float = 0.0
    damping2: float = 0.0
    friction: float = 0.0
    stiffness: float = 0.0
    offset: float = 0.0
    gain: float = 1.0


@dataclass(frozen=True, eq=False)
class SimArm:
    """The whole arm.

    Args:
        robot: the description, geometry of the model included.
        joints: in order.
        flange: (3, 3), (3,) [m] of the flange in the last body, and its name.
        payload: (10,) inertial parameters of a load, in the flange's frame; the last body has it in its own.
        gravity: (3,) [m/s^2] in base.
        delay: torques act (or are recorded) so much later [s].
        left: what no simulator has a place for.
        source: the recording the model was learnt from.
    """

    robot: RobotModel
    joints: tuple[SimJoint, ...]
    flange: tuple[np.ndarray, np.ndarray, str]
    payload: np.ndarray
    gravity: np.ndarray
    delay: float
    left: tuple[Left, ...]
    source: str

    @property
    def name(self) -> str:
        return "".join(c if c.isalnum() or c == "_" else "_" for c in self.robot.name) or "arm"


def about_centre(inertial: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """(10,) parameters -> mass [kg], centre (3,) [m], inertia (3, 3) about the centre [kg m^2]."""
    mass = float(inertial[0])
    xx, xy, yy, xz, yz, zz = inertial[4:]
    about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    if mass <= 0.0:
        return 0.0, np.zeros(3), about
    centre = inertial[1:4] / mass
    return mass, centre, about - mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
