"""USD with UsdPhysics, written as text (.usda) so that nothing has to be installed for it.

UsdPhysics itself has no friction and no rotor inertia in a joint. They stand in the schemas of those who read USD:
PhysX (`physxJoint…`, per degree where it turns), and MuJoCo (`mjc:…`, SI). Isaac Sim read URDF friction and damping
differently from version to version: what counts is what stands here, by name and unit.
"""

from __future__ import annotations

import numpy as np

from app.diagnosis.export.arm import Left, SimArm, SimJoint, about_centre
from app.diagnosis.export.targets._words import joint_names, lateness, lost, named, remark
from app.geometry import quaternion_from_rotation
from app.units import deg, from_deg

_NO_WORD = "neither UsdPhysics nor PhysX nor MuJoCo's schema has a word for it"


class Usd:
    key = "usd"
    title = "OpenUSD, UsdPhysics"
    version = "25.11 and later; PhysX schema of Isaac Sim 5 and later, MuJoCo schema of 2025"
    suffix = ".usda"

    def write(self, arm: SimArm) -> tuple[str, tuple[Left, ...]]:
        left = lost(arm, ("damping2", "offset", "gain"), _NO_WORD)
        if arm.delay:
            left.append(lateness(arm, _NO_WORD))
        form = f"{self.title} {self.version}"
        size = float(np.linalg.norm(arm.gravity))
        down = arm.gravity / size if size else np.array([0.0, 0.0, -1.0])
        lines = [
            "#usda 1.0",
            "(",
            f'    defaultPrim = "{arm.name}"',
            "    metersPerUnit = 1",
            "    kilogramsPerUnit = 1",
            '    upAxis = "Z"',
            ")",
            remark(arm, form, (*arm.left, *left), "# "),
            'def PhysicsScene "physicsScene"',
            "{",
            f"    vector3f physics:gravityDirection = {_tuple(down)}",
            f"    float physics:gravityMagnitude = {size!r}",
            "}",
            f'def Xform "{arm.name}" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])',
            "{",
            '    def Xform "base" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])',
            "    {",
            "        float physics:mass = 1",
            "    }",
            '    def PhysicsFixedJoint "on_the_ground"',
            "    {",
            f"        rel physics:body1 = </{arm.name}/base>",
            "    }",
        ]
        place = (np.eye(3), np.zeros(3))
        parent = "base"
        for name, joint in zip(joint_names(arm), arm.joints, strict=True):
            place = (place[0] @ joint.rotation, place[1] + place[0] @ joint.position)
            lines += _body(joint, *place)
            lines += _joint(arm.name, name, parent, joint)
            parent = joint.body
        lines += _flange(arm, *place)
        return "\n".join([*lines, "}", ""]), tuple(left)


def _tuple(values) -> str:
    return "(" + ", ".join(repr(float(v) + 0.0) for v in values) + ")"


def _quat(rotation: np.ndarray) -> str:
    return _tuple(quaternion_from_rotation(rotation))


def _xform(rotation: np.ndarray, position: np.ndarray, indent: str) -> list[str]:
    return [
        f"{indent}quatd xformOp:orient = {_quat(rotation)}",
        f"{indent}double3 xformOp:translate = {_tuple(position)}",
        f'{indent}uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]',
    ]


def _body(joint: SimJoint, rotation: np.ndarray, position: np.ndarray) -> list[str]:
    mass, centre, about = about_centre(joint.inertial)
    values, axes = np.linalg.eigh(about)
    if np.linalg.det(axes) < 0:
        axes[:, 2] *= -1.0
    return [
        f'    def Xform "{joint.body}" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])',
        "    {",
        *_xform(rotation, position, "        "),
        f"        float physics:mass = {mass!r}",
        f"        point3f physics:centerOfMass = {_tuple(centre)}",
        f"        float3 physics:diagonalInertia = {_tuple(values)}",
        f"        quatf physics:principalAxes = {_quat(axes)}",
        "    }",
    ]


def _joint(arm: str, name: str, parent: str, joint: SimJoint) -> list[str]:
    """UsdPhysics' joints turn about X of their own frame: it is laid along the axis on both sides."""
    along = _frame_with_x(joint.axis)
    kind, drive = ("Prismatic", "linear") if joint.prismatic else ("Revolute", "angular")
    edge = (lambda v: v) if joint.prismatic else deg
    per_edge = (lambda v: v) if joint.prismatic else from_deg  # Nm s/rad -> Nm s/deg
    apis = [f"PhysicsDriveAPI:{drive}", f"PhysxJointAxisAPI:{drive}", "PhysxJointAPI", "MjcJointAPI"]
    applied = ", ".join(f'"{api}"' for api in apis)
    lines = [
        f'    def Physics{kind}Joint "{name}" (prepend apiSchemas = [{applied}])',
        "    {",
        '        uniform token physics:axis = "X"',
        f"        rel physics:body0 = </{arm}/{parent}>",
        f"        rel physics:body1 = </{arm}/{joint.body}>",
        f"        point3f physics:localPos0 = {_tuple(joint.position)}",
        f"        quatf physics:localRot0 = {_quat(joint.rotation @ along)}",
        "        point3f physics:localPos1 = (0, 0, 0)",
        f"        quatf physics:localRot1 = {_quat(along)}",
        f"        float physics:lowerLimit = {float(edge(joint.lower))!r}",
        f"        float physics:upperLimit = {float(edge(joint.upper))!r}",
        f'        uniform token drive:{drive}:physics:type = "force"',
        f"        float drive:{drive}:physics:stiffness = {float(per_edge(joint.stiffness))!r}",
        f"        float drive:{drive}:physics:damping = {float(per_edge(joint.damping))!r}",
        f"        float drive:{drive}:physics:targetPosition = 0",
        f"        float physxJointAxis:{drive}:armature = {joint.armature!r}",
        f"        float physxJointAxis:{drive}:staticFrictionEffort = {joint.friction!r}",
        f"        float physxJointAxis:{drive}:dynamicFrictionEffort = {joint.friction!r}",
        f"        float physxJointAxis:{drive}:viscousFrictionCoefficient = 0",
        f"        float physxJoint:armature = {joint.armature!r}",
        f"        double mjc:armature = {joint.armature!r}",
        f"        double mjc:frictionloss = {joint.friction!r}",
        f"        double mjc:damping = {joint.damping!r}",
        f"        double mjc:stiffness = {joint.stiffness!r}",
    ]
    if joint.effort > 0.0:
        lines.append(f"        float drive:{drive}:physics:maxForce = {joint.effort!r}")
    return [*lines, "    }"]


def _frame_with_x(axis: np.ndarray) -> np.ndarray:
    """(3, 3) a rotation whose X lies along `axis`."""
    helper = np.eye(3)[int(np.argmin(np.abs(axis)))]
    second = np.cross(axis, helper)
    second /= np.linalg.norm(second)
    return np.stack([axis, second, np.cross(axis, second)], axis=1)


def _flange(arm: SimArm, rotation: np.ndarray, position: np.ndarray) -> list[str]:
    turn, step, name = arm.flange
    return [
        f'    def Xform "{named(name)}"',
        "    {",
        *_xform(rotation @ turn, position + rotation @ step, "        "),
        "    }",
    ]


TARGET = Usd()
