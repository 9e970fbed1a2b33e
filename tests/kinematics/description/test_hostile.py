"""Descriptions made to break: one line each, before any compiled library sees them."""

import time

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.errors import InputError
from app.kinematics import CollisionWorld, load_robot
from app.kinematics.solids import robot_shapes
from tests.kinematics.description.making import LIMIT, description, fixed, joint, line

BOX = '<link name="base"><visual><geometry>{}</geometry></visual></link>'
ARM = description(line(2))


def refused(tmp_path, text, problem):
    path = tmp_path / "arm.urdf"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    began = time.process_time()
    with pytest.raises(InputError) as caught:
        robot_shapes(load_robot(path))
    said = str(caught.value)
    assert problem in said and "arm.urdf" in said and "\n" not in said and len(said) < 700
    assert time.process_time() - began < 5


@pytest.mark.parametrize(
    "before, after, problem",
    [
        ('axis xyz="0 0 1"', 'axis xyz="0 0 0"', "has no direction"),
        ('axis xyz="0 0 1"', 'axis xyz="0 0 nan"', "axis xyz of joint 'j1'"),
        ('xyz="0 0 0.1"', 'xyz="1e308 0 0"', "origin xyz of joint 'j1'"),
        ('xyz="0 0 0.1"', 'xyz="1e30 0 0"', "at most"),
        ('xyz="0 0 0.1"', 'xyz="0 0"', "3 numbers"),
        ('name="j1"', 'name="universe"', "universe"),
        ('name="l1"', 'name="universe"', "universe"),
        ('lower="-2.9" upper="2.9"', 'lower="3" upper="-3"', "crossed"),
        ('upper="2.9"', 'upper="nan"', "limit upper"),
        ('<link name="base"/>', BOX.format('<box size="nan nan nan"/>'), "box size of link 'base'"),
        ('<link name="base"/>', BOX.format('<sphere radius="1e300"/>'), "sphere radius"),
        ('<link name="base"/>', BOX.format('<cylinder radius="-1" length="1"/>'), "not negative"),
        ('<link name="base"/>', '<link name="base"><inertial><mass value="-3"/></inertial></link>', "not negative"),
        ('<link name="l1"/>', '<link name="l1"/><link name="l1"/>', "two links"),
        ('<joint name="j2"', '<joint name="j1"', "two joints"),
        ('<link name="l1"/>', "", "not there"),
        ("<robot", '<?xml version="1.0" encoding="klingon"?><robot', "not XML"),
        ("<robot", '<!DOCTYPE r [<!ENTITY a "aaaa">]><robot', "entity"),
    ],
)  # fmt: skip
def test_what_no_robot_has_is_named(tmp_path, before, after, problem):
    assert before in ARM
    refused(tmp_path, ARM.replace(before, after, 1), problem)


@pytest.mark.parametrize(
    "text, problem",
    [
        ("<a>" * 100000, "deep"),
        (b"\xff\xfe" + ARM.encode("utf-16-le")[:-7], "not XML"),
        (b"\x00" * 5000, "not XML"),
        (description([fixed(f"f{k}", f"n{k}", f"n{k + 1}") for k in range(2000)]), "at most 1000"),
        (description([joint(f"s{k}", "base", f"leaf{k}") for k in range(3000)]), "at most 1000"),
        ("<robot>" + "<link/>" * 300000 + "</robot>", "elements"),
    ],
    ids=["deep", "half a letter", "zeros", "chain", "star", "many"],
)
def test_endless_descriptions_are_refused_in_seconds(tmp_path, text, problem):
    refused(tmp_path, text, problem)


def test_a_chain_of_nine_hundred_fixed_links_loads_in_seconds(tmp_path):
    mass = (
        '<inertial><mass value="0.1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    )
    text = description([*line(1), *(fixed(f"f{k}", f"l{k}", f"l{k + 1}", "0 0 0.01") for k in range(1, 900))])
    path = tmp_path / "arm.urdf"
    path.write_text(text.replace('<link name="l500"/>', f'<link name="l500">{mass}</link>'))
    began = time.process_time()
    robot = load_robot(path)
    assert robot.joint_count == 1 and robot.chain.masses[0] == pytest.approx(0.1)
    assert time.process_time() - began < 5


@pytest.mark.parametrize(
    "shape", ['<box size="4e-7 4e-7 4e-7"/>', '<sphere radius="0"/>', '<cylinder radius="0" length="1"/>']
)
def test_a_solid_too_thin_to_hull_is_left_out(tmp_path, shape):
    path = tmp_path / "arm.urdf"
    path.write_text(ARM.replace('<link name="l1"/>', BOX.replace("base", "l1").format(shape)))
    robot = load_robot(path)
    CollisionWorld(robot).check(robot.home)


@pytest.mark.parametrize("place", ["/dev/zero", "/dev/null", "."])
def test_what_is_no_ordinary_file_is_refused(place):
    with pytest.raises(InputError):
        load_robot(place)


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.lists(
        st.tuples(
            st.sampled_from(['"0 0 1"', '"0.1"', "revolute", "<axis", "l1", "<link", LIMIT, "lower", "/>", "base"]),
            st.sampled_from(['"1e400"', '"nan"', "mimic", "fixed", "floating", "", "<joint", "universe", "é\x01", '"']),
            st.integers(1, 3),
        ),
        min_size=1,
        max_size=3,
    )
)  # fmt: skip
def test_any_change_gives_a_robot_or_one_line(tmp_path, changes):
    text = description([*line(2), fixed("f", "l2", "tool0", "0 0 0.1")])
    for before, after, count in changes:
        text = text.replace(before, after, count)
    path = tmp_path / "arm.urdf"
    path.write_text(text)
    try:
        robot = load_robot(path)
        CollisionWorld(robot).check(robot.home)
    except InputError as error:
        assert "\n" not in str(error)
