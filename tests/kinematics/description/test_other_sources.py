"""Robots that come as macros, as a table of Denavit-Hartenberg rows, or with their maker's calibration."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np
import pytest

from app.errors import InputError
from app.geometry import Pose
from app.geometry.rotation import rot_x, rot_z
from app.kinematics import load_robot
from app.kinematics.description.dhtable import DhRow
from app.kinematics.description.urcalibration import MODELS, _yaml_axes, bare_arm, model_of, nominal_rows

MACRO = """<robot name="m" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:macro name="turn" params="n p c"><joint name="${n}" type="revolute"><parent link="${p}"/><child link="${c}"/>
<origin xyz="0 0 ${sizes['rise']/2}"/><axis xyz="0 1 0"/><limit lower="${-pi}" upper="${pi}" velocity="1" effort="1"/>
</joint></xacro:macro></robot>"""
ARM = """<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:property name="sizes" value="${xacro.load_yaml('$(find pack)/config/sizes.yaml')}"/>
<xacro:include filename="$(find pack)/urdf/macro.xacro"/>
<link name="base"/><link name="l1"/><link name="tool0"/>
<xacro:turn n="j1" p="base" c="l1"/><xacro:turn n="j2" p="l1" c="tool0"/></robot>"""


@pytest.fixture
def package(tmp_path):
    folder = tmp_path / "ws" / "pack"
    for name, text in (
        ("package.xml", "<package><name>pack</name></package>"),
        ("urdf/macro.xacro", MACRO),
        ("urdf/arm.urdf.xacro", ARM),
        ("config/sizes.yaml", "rise: 0.4"),
    ):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    (tmp_path / "secret.yaml").write_text("rise: 1")
    return folder


def test_macros_are_expanded_with_what_lies_in_the_packages(package):
    robot = load_robot(package / "urdf" / "arm.urdf.xacro")
    assert robot.joint_count == 2 and robot.name == "arm" and robot.flange == "tool0"
    assert robot.forward(np.zeros(2)).position == pytest.approx([0, 0, 0.4])


@pytest.mark.parametrize(
    "before, after, problem",
    [
        ("$(find pack)/config/sizes.yaml", "{secret}", "outside"),
        ("$(find pack)/urdf/macro.xacro", "/etc/hostname", "outside"),
        ("$(find pack)/urdf", "$(find nothing)/urdf", "xacro"),
        ("sizes['rise']/2", "().__class__", "xacro"),
        ("sizes['rise']/2", "[x for x in range(10**9) for y in range(10**9)]", "xacro"),
    ],
)
def test_macros_reach_no_further_than_their_packages(package, before, after, problem):
    for path in (package / "urdf").iterdir():
        text = path.read_text().replace(before, after.format(secret=package.parent.parent / "secret.yaml"))
        path.write_text(text)
    with pytest.raises(InputError) as caught:
        load_robot(package / "urdf" / "arm.urdf.xacro")
    assert problem in str(caught.value) and "\n" not in str(caught.value)


def standard(rows, q):
    pose = Pose.identity()
    for row, angle in zip(rows, q, strict=True):
        pose = pose @ Pose.of(rot_z(row.theta + angle), np.array([0, 0, row.d]))
        pose = pose @ Pose.of(rot_x(row.alpha), np.array([row.a, 0, 0])) if False else pose @ Pose.of(
            None, np.array([row.a, 0, 0])
        ) @ Pose.of(rot_x(row.alpha), np.zeros(3))  # fmt: skip
    return pose


ROWS = [DhRow(0.0, np.pi / 2, 0.18, 0.1), DhRow(-0.6, 0.2, 0.03, 0.0), DhRow(0.1, -1.2, 0.3, -0.5)]


def table(folder, convention, kinds=("revolute",) * 3):
    lines = [f"# convention: {convention}", "a_mm,alpha_deg,d_mm,theta_deg,type,lower_deg,upper_deg"]
    for row, kind in zip(ROWS, kinds, strict=True):
        numbers = (row.a * 1e3, np.degrees(row.alpha), row.d * 1e3, np.degrees(row.theta))
        lines.append(",".join(f"{v:.12g}" for v in numbers) + f",{kind},-180,180")
    path = folder / "arm.csv"
    path.write_text("\n".join(lines) + "\n")
    return path


def test_a_standard_table_is_its_own_formula(tmp_path):
    robot = load_robot(table(tmp_path, "standard"))
    for q in np.random.default_rng(0).uniform(-3, 3, (5, 3)):
        assert np.allclose(robot.forward(q).matrix, standard(ROWS, q).matrix)
    assert robot.upper == pytest.approx([np.pi] * 3)


def test_a_modified_table_is_craigs_formula_and_rows_may_slide(tmp_path):
    robot = load_robot(table(tmp_path, "modified", ("revolute", "prismatic", "revolute")))
    q = np.array([0.4, 0.25, -1.0])
    pose = Pose.identity()
    for row, value, slides in zip(ROWS, q, (False, True, False), strict=True):
        pose = pose @ Pose.of(rot_x(row.alpha), np.array([row.a, 0, 0]))
        turn, rise = (0.0, value) if slides else (value, 0.0)
        pose = pose @ Pose.of(rot_z(row.theta + turn), np.array([0, 0, row.d + rise]))
    assert np.allclose(robot.forward(q).matrix, pose.matrix)


@pytest.mark.parametrize(
    "text, problem",
    [
        ("a_mm,alpha_deg,d_mm\n1,2,3\n", "column theta_deg or theta_rad"),
        ("a,alpha_deg,d_mm,theta_deg\n1,2,3,4\n", "column a_mm or a_m"),
        ("a_mm,alpha_deg,d_mm,theta_deg\n1,x,3,4\n", "row 2, column alpha_deg: found 'x'"),
        ("# convention: mine\na_mm,alpha_deg,d_mm,theta_deg\n1,2,3,4\n", "standard or modified"),
        ("a_mm,alpha_deg,d_mm,theta_deg,type\n1,2,3,4,round\n", "revolute or prismatic"),
        ("a_mm,alpha_deg,d_mm,theta_deg\n", "0 joints"),
    ],
)
def test_a_table_that_is_none_is_named_by_its_cell(tmp_path, text, problem):
    (tmp_path / "arm.csv").write_text(text)
    with pytest.raises(InputError) as caught:
        load_robot(tmp_path / "arm.csv")
    assert problem in str(caught.value)


DELTAS = {
    "delta_theta": [1e-3, -0.2, 0.31, -0.11, 2e-4, -3e-4],
    "delta_a": [1e-4, 3e-3, -2e-3, 1e-4, -1e-4, 0.0],
    "delta_d": [2e-4, 12.5, -31.0, 18.5, 1e-4, -2e-4],  # parallel axes: feet far along them
    "delta_alpha": [1e-4, 1e-3, -8e-4, 2e-4, -1e-4, 0.0],
}


def conf(folder, deltas=DELTAS):
    path = folder / "calibration.conf"
    path.write_text(
        "[mounting]\n" + "\n".join(f"{k} = {v}" for k, v in deltas.items()) + "\n[joint]\nx = 1\n"
    )
    return path


def small(deltas):
    return {k: [v if abs(v) < 0.01 else 0.0 for v in values] for k, values in deltas.items()}


@pytest.mark.parametrize("deltas", [small(DELTAS), {k: [0.0] * 6 for k in DELTAS}])
@pytest.mark.parametrize("name", ["ur10e", "ur5"])
def test_a_calibrated_ur_stands_where_its_dh_rows_say(tmp_path, name, deltas):
    robot = load_robot(f"{name}#calibration={conf(tmp_path, deltas)}")
    rows = [
        DhRow(r.a + da, r.alpha + dal, r.d + dd, r.theta + dt)
        for r, da, dal, dd, dt in zip(
            nominal_rows(name, tmp_path),
            *(deltas[f"delta_{k}"] for k in ("a", "alpha", "d", "theta")),
            strict=True,
        )
    ]
    shipped = load_robot(name)
    for q in np.random.default_rng(3).uniform(-2, 2, (5, 6)):
        assert np.allclose(robot.forward(q).matrix, standard(rows, q).matrix, atol=1e-9)
        if not any(map(any, deltas.values())):
            assert np.allclose(robot.forward(q).matrix, shipped.forward(q).matrix, atol=1e-9)
    assert np.allclose(robot.chain.masses, shipped.chain.masses)


@pytest.mark.parametrize("name", sorted(set(MODELS) - {"ur5", "ur10e"}))
def test_every_model_of_the_maker_is_known_by_its_table_and_takes_a_calibration(tmp_path, name):
    bare, deltas = load_robot(name), small(DELTAS)
    own = load_robot(f"{name}#calibration={conf(tmp_path, deltas)}")
    q = np.array([0.3, -1.2, 0.8, 0.1, 0.5, -0.4])
    rows = nominal_rows(name, tmp_path)
    moved = [
        DhRow(r.a + a, r.alpha + al, r.d + d, r.theta + t)
        for r, a, al, d, t in zip(
            rows, *(deltas[f"delta_{k}"] for k in ("a", "alpha", "d", "theta")), strict=True
        )
    ]
    assert np.allclose(bare.forward(q).matrix, standard(rows, q).matrix, atol=1e-9)
    assert np.allclose(own.forward(q).matrix, standard(moved, q).matrix, atol=1e-9)
    assert bare.flange == own.flange == "flange"
    assert load_robot(own.address).address == own.address


@pytest.mark.parametrize("model", sorted(MODELS))
def test_a_persons_own_description_of_such_an_arm_is_known_by_its_axes(tmp_path, model):
    path = tmp_path / "my_cell.urdf"
    root = bare_arm(model)
    root.set("name", "left")
    path.write_text(ET.tostring(root, encoding="unicode"))
    assert model_of("my_cell", root, path) == model
    deltas = small(DELTAS)
    own = load_robot(f"{path}#calibration={conf(tmp_path, deltas)}")
    q = np.array([0.3, -1.2, 0.8, 0.1, 0.5, -0.4])
    assert np.allclose(
        own.forward(q).matrix, load_robot(f"{model}#calibration={conf(tmp_path, deltas)}").forward(q).matrix
    )


def test_an_arm_of_another_maker_takes_no_such_calibration(tmp_path):
    with pytest.raises(InputError, match="the axes of no model of Universal Robots"):
        load_robot(f"irb120#calibration={conf(tmp_path, small(DELTAS))}")


def test_feet_far_along_parallel_axes_keep_the_links_where_they_are(tmp_path):
    far = {**small(DELTAS), "delta_d": [0.0, 12.5, -31.0, 18.5, 0.0, 0.0]}
    far["delta_alpha"] = [0.0] * 6
    robot = load_robot(f"ur10e#calibration={conf(tmp_path, far)}")
    assert np.abs(robot.chain.translations).max() < 1.0
    rows = [
        DhRow(r.a + da, r.alpha, r.d + dd, r.theta + dt)
        for r, da, dd, dt in zip(
            nominal_rows("ur10e", tmp_path), *(far[f"delta_{k}"] for k in ("a", "d", "theta")), strict=True
        )
    ]
    q = np.array([0.3, -1.2, 0.8, 0.1, 0.5, -0.4])
    assert np.allclose(robot.forward(q).matrix, standard(rows, q).matrix, atol=1e-9)


def test_the_yaml_of_a_controller_is_read_too(tmp_path):
    names = ("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3")
    rows = {
        "shoulder": (0.0001, 0, 0.1808, 0.0002, 0, 0.0003),
        "upper_arm": (0, 0.0002, 0, 1.5708, 0, -0.0001),
        "forearm": (-0.6131, 0, 0, 0, 0.0001, 0.0002),
        "wrist_1": (-0.5712, -0.0001, 0.1742, 0.0003, 0, 0),
        "wrist_2": (0, -0.1199, 0, 1.5709, 0, 0.0002),
        "wrist_3": (0, 0.1166, 0, 1.5707, 3.14159265, -3.14159265),
    }
    lines = ["kinematics:"]
    for name in names:
        keys = zip(("x", "y", "z", "roll", "pitch", "yaw"), rows[name], strict=True)
        lines.append(f"  {name}:\n" + "\n".join(f"    {k}: {v}" for k, v in keys))
    path = tmp_path / "kinematics.yaml"
    path.write_text("\n".join([*lines, "  hash: calib_1"]))
    robot = load_robot(f"ur10e#calibration={path}")
    from app.kinematics.description.placing import pose_of

    steps = [pose_of(np.array(rows[n][:3]), np.array(rows[n][3:])) for n in names]
    assert np.allclose(robot.forward(np.zeros(6)).matrix, _yaml_axes(steps)[-1].matrix, atol=1e-7)
    pose = Pose.identity()
    q = np.array([0.2, -0.7, 0.5, 0.3, -0.1, 0.6])
    for step, angle in zip(steps, q, strict=True):
        pose = pose @ step @ Pose.of(rot_z(angle), np.zeros(3))
    assert np.allclose(robot.forward(q).matrix, pose.matrix, atol=1e-7)


@pytest.mark.parametrize(
    "text, problem",
    [
        ("", "no section"),
        ("[mounting]\ndelta_theta = [1, 2]\ndelta_a = []\ndelta_d = []\ndelta_alpha = []\n", "six numbers"),
        ("kinematics: {shoulder: 1}", "not six links"),
        ("kinematics: &a [*a]", "not six links"),
        ("[mounting]\n" + "\n".join(f"{k} = [9, 9, 9, 9, 9, 9]" for k in DELTAS), "m from the model's"),
    ],
)
def test_a_calibration_that_is_none_is_named(tmp_path, text, problem):
    path = tmp_path / "c.conf"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        load_robot(f"ur10e#calibration={path}")
    assert problem in str(caught.value) and "c.conf" in str(caught.value)
