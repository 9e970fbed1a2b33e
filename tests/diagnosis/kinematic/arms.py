"""Arms for the tests, written as URDFs."""

from pathlib import Path

from app.kinematics import load_robot

_SIX = [
    ("z", "0 0 0.3", 8, "0 0 -0.05"),
    ("y", "0.1 0.12 0.1", 12, "0 0 0.2"),
    ("y", "0 -0.05 0.5", 8, "0.15 0 0.05"),
    ("x", "0.25 0.02 0.08", 3, "0.1 0 0"),
    ("y", "0.25 0 0", 2, "0.03 0 0"),
    ("x", "0.1 0 0.03", 1, "0.02 0 0"),
]


def write_arm(path: Path, joints=_SIX, *, masses=True, prismatic=()):
    """A serial arm: (axis, origin, mass, centre) a joint; numbers of sliding joints in `prismatic`."""
    lines = ['<robot name="arm">', '<link name="base"/>']
    parent = "base"
    for k, (axis, origin, mass, centre) in enumerate(joints, start=1):
        vector = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}[axis]
        slides = k in prismatic
        limits = 'lower="-0.4" upper="0.4"' if slides else 'lower="-2.6" upper="2.6"'
        inertial = (
            f'<inertial><origin xyz="{centre}"/><mass value="{mass}"/>'
            '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'
        )
        lines.append(f'<link name="l{k}">{inertial if masses else ""}</link>')
        lines.append(
            f'<joint name="j{k}" type="{"prismatic" if slides else "revolute"}"><parent link="{parent}"/>'
            f'<child link="l{k}"/><origin xyz="{origin}"/><axis xyz="{vector}"/>'
            f'<limit {limits} effort="100" velocity="2"/></joint>'
        )
        parent = f"l{k}"
    lines.append('<link name="tool0"/>')
    lines.append(
        f'<joint name="flange" type="fixed"><parent link="{parent}"/><child link="tool0"/>'
        '<origin xyz="0.08 0 0" rpy="0 1.5707963 0"/></joint></robot>'
    )
    path.write_text("\n".join(lines))
    return load_robot(path)
