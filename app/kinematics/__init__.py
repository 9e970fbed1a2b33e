"""Arms: what a URDF says, where the flange is, how to get it somewhere. The only package that imports pin.

robot.py       RobotModel: forward kinematics, Jacobian, gravity torques, limits
loading.py     finds a robot by name or path and reads its URDF
chain.py       the arm as plain arrays, for many poses at once
inverse.py     damped inverse kinematics that says why it stopped
shapes.py      the solids a description draws its links with
solids.py      the same as convex hulls and meshes, to draw and to hit
collision.py   what the arm, its tool and its surroundings touch
contact.py     how far a carried thing is from a standing one
"""

from app.kinematics.chain import Chain
from app.kinematics.collision import CollisionWorld, ContactPair
from app.kinematics.contact import Contact
from app.kinematics.inverse import IkResult, solve_ik
from app.kinematics.loading import load_robot, robot_names
from app.kinematics.robot import Joint, RobotModel

__all__ = [
    "Chain",
    "CollisionWorld",
    "Contact",
    "ContactPair",
    "IkResult",
    "Joint",
    "RobotModel",
    "load_robot",
    "robot_names",
    "solve_ik",
]
