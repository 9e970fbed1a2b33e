"""Descriptions that once ended the process: each in a process of its own, drawn, collided and moved, or refused.

What is refused and with which words: tests/kinematics/description/test_hostile.py. A server reads every description
that is sent to it apart: tests/shell/test_reading_apart.py.
"""

import pytest

from tests.hardening.small import MOST_MEMORY, MOST_SECONDS, ran
from tests.kinematics.description.making import description, joint, line

ARM = description(line(3))
SHAPE = '<link name="l1"><collision><geometry>{}</geometry></collision></link>'
BOXES = '<collision><geometry><box size="1 1 1"/></geometry></collision>' * 500
INERTIA = '<link name="l1"><inertial><mass value="{}"/><inertia {}/></inertial></link>'
CHANGES = {
    "zero axis": ('axis xyz="0 0 1"', 'axis xyz="0 0 0"'),
    "tiny axis": ('axis xyz="0 0 1"', 'axis xyz="1e-320 0 0"'),
    "axis of four": ('axis xyz="0 0 1"', 'axis xyz="0 0 1 0"'),
    "no number": ('xyz="0 0 0.1"', 'xyz="nan 0 0.1"'),
    "far away": ('xyz="0 0 0.1"', 'xyz="1e30 0 0"'),
    "far, but finite": ('xyz="0 0 0.1"', 'xyz="99999 99999 99999"'),
    "universe": ('name="j1"', 'name="universe"'),
    "box of 1e30": ('<link name="l1"/>', SHAPE.format('<box size="1e30 1 1"/>')),
    "box of nothing": ('<link name="l1"/>', SHAPE.format('<box size="0 0 0"/>')),
    "box of 4e-7": ('<link name="l1"/>', SHAPE.format('<box size="4e-7 4e-7 4e-7"/>')),
    "flat box": ('<link name="l1"/>', SHAPE.format('<box size="1 1 1e-12"/>')),
    "sphere of nan": ('<link name="l1"/>', SHAPE.format('<sphere radius="nan"/>')),
    "sphere of 1e300": ('<link name="l1"/>', SHAPE.format('<sphere radius="1e300"/>')),
    "needle": ('<link name="l1"/>', SHAPE.format('<cylinder radius="1e-300" length="1e5"/>')),
    "capsule of nothing": ('<link name="l1"/>', SHAPE.format('<capsule radius="0" length="0"/>')),
    "many solids": ('<link name="l1"/>', f'<link name="l1">{BOXES}</link>'),
    "inertia below zero": ('<link name="l1"/>', INERTIA.format(1, 'ixx="-1" iyy="-1" izz="-1"')),
    "wild inertia": ('<link name="l1"/>', INERTIA.format("1e-320", 'ixx="1e6" iyy="1" izz="1" ixy="1e5"')),
    "damping of nan": ("</joint>", '<dynamics damping="nan" friction="-1e308"/></joint>'),
    "limits crossed": ('lower="-2.9" upper="2.9"', 'lower="3" upper="-3"'),
    "limits without end": ('lower="-2.9" upper="2.9" velocity="2"', 'lower="-inf" upper="inf" velocity="inf"'),
    "digits of another script": ('xyz="0 0 0.1"', 'xyz="0 0 \u0661"'),
    "digits in groups": ('xyz="0 0 0.1"', 'xyz="0 0 0.000_1"'),
    "hardly a number": ('xyz="0 0 0.1"', 'xyz="0 0 1e-320"'),
    "no room to move": ('lower="-2.9" upper="2.9"', 'lower="0" upper="0"'),
    "mesh that is none": ('<link name="l1"/>', SHAPE.format('<mesh filename="/etc/passwd"/>')),
    "mesh without end": ('<link name="l1"/>', SHAPE.format('<mesh filename="file:///dev/zero"/>')),
    "mesh of no size": ('<link name="l1"/>', SHAPE.format('<mesh filename="a.stl" scale="0 0 0"/>')),
}  # fmt: skip


@pytest.mark.parametrize("name", CHANGES)
def test_a_cell_with_it_is_recorded_or_the_description_is_refused_in_one_line(name, tmp_path):
    before, after = CHANGES[name]
    assert before in ARM
    (tmp_path / "a.stl").write_bytes(b"\0" * 80 + b"\xff\xff\xff\xff" + b"\0" * 100)
    (tmp_path / "arm.urdf").write_text(ARM.replace(before, after, 1))
    found = ran("simulate", "--robot", "arm.urdf", "--kind", "tracker", "out.csv", folder=tmp_path)
    assert found.code in (0, 2) and "urdfdom" not in found.err, (
        found
    )  # nor does a library speak to the terminal
    assert found.code == 0 or (len(found.err.splitlines()) == 1 and "arm.urdf" in found.err), found
    assert found.seconds < MOST_SECONDS and found.memory < MOST_MEMORY, found


@pytest.mark.parametrize("count", [30, 200])
def test_an_arm_of_very_many_joints_is_answered(count, tmp_path):
    joints = [joint(f"j{k}", "base" if k == 1 else f"l{k - 1}", f"l{k}") for k in range(1, count + 1)]
    (tmp_path / "arm.urdf").write_text(description(joints))
    found = ran("simulate", "--robot", "arm.urdf", "--kind", "touch", "out.csv", folder=tmp_path)
    assert found.code in (0, 2) and found.memory < MOST_MEMORY, found
    assert found.seconds < 4 * MOST_SECONDS, found
