"""URDF, SDF and USD, read back by public parsers: the same torques and numbers; what has no place is listed."""

import numpy as np
import pytest

from app.cli import run
from app.diagnosis.export import export_model, targets
from app.diagnosis.model import ModelEffect, SavedModel, save_model
from app.kinematics import load_robot
from app.kinematics.dynamics import inverse_dynamics
from tests.diagnosis.export import models

TORQUE = 1e-6  # Nm
SINGLE = 2e-6  # relative: USD's physics schema keeps single precision


@pytest.fixture(scope="module")
def robot():
    return load_robot("ur10e")


@pytest.fixture(scope="module")
def motion(robot):
    return models.trajectory(robot, 60)


def without_friction(robot, motion):
    q, qd, qdd = motion
    return models.rigid_torque(robot, q, qd, qdd) - np.array(models.VISCOUS) * qd


def test_urdf_read_by_pin_needs_the_same_torques(robot, motion, tmp_path):
    exported = export_model(robot, models.model(robot, (*models.rigid_laws(), *models.dry())), "urdf")
    path = tmp_path / "found.urdf"
    path.write_text(exported.text)
    again = load_robot(path)
    assert np.abs(inverse_dynamics(again, *motion) - without_friction(robot, motion)).max() < TORQUE
    np.testing.assert_allclose(again.flange_matrix(robot.home), robot.flange_matrix(robot.home), atol=1e-12)
    yourdfpy = pytest.importorskip("yourdfpy")
    joints = yourdfpy.URDF.load(str(path), build_scene_graph=False).robot.joints
    dynamics = [j.dynamics for j in joints if j.type == "revolute"]
    assert [float(d.damping) for d in dynamics] == pytest.approx(models.VISCOUS)
    assert [float(d.friction) for d in dynamics] == pytest.approx(models.COULOMB)
    assert exported.left == ()


def test_sdf_read_by_drake_needs_the_same_torques(robot, motion):
    parsing = pytest.importorskip(
        "pydrake.multibody.parsing", reason="the extra teachframe[sdf] is not installed"
    )
    from pydrake.multibody.plant import MultibodyPlant
    from pydrake.multibody.tree import MultibodyForces

    leaning = models.effect("gravity_direction", {"body": "base"}, gx=0.4, gy=-0.3, gz=-9.79)
    exported = export_model(robot, models.model(robot, (*models.rigid_laws(), leaning)), "sdf")
    plant = MultibodyPlant(0.0)
    parser = parsing.Parser(plant)
    parser.AddModelsFromString(exported.text, "sdf")
    plant.mutable_gravity_field().set_gravity_vector(models.GRAVITY_LEANING)
    plant.Finalize()
    context = plant.CreateDefaultContext()
    q, qd, qdd = motion
    got = np.empty(q.shape)
    for i in range(len(q)):
        plant.SetPositions(context, q[i])
        plant.SetVelocities(context, qd[i])
        forces = MultibodyForces(plant)
        plant.CalcForceElementsContribution(context, forces)
        got[i] = plant.CalcInverseDynamics(context, qdd[i], forces)
    expected = models.rigid_torque(robot, *motion, gravity=models.GRAVITY_LEANING)
    assert np.abs(got - expected).max() < TORQUE
    assert exported.left == ()


def test_usd_read_by_openusd_has_the_same_numbers(robot):
    usd = pytest.importorskip("pxr.Usd", reason="the extra teachframe[usd] is not installed")
    from pxr import UsdGeom, UsdPhysics

    effects = (*models.rigid_laws(), *models.dry(), models.effect("rotor_inertia", {"joint": 2}, inertia=1.3))
    exported = export_model(robot, models.model(robot, effects), "usd")
    layer = __import__("pxr.Sdf", fromlist=["Layer"]).Layer.CreateAnonymous(".usda")
    assert layer.ImportFromString(exported.text)
    stage = usd.Stage.Open(layer)
    joints = [p for p in stage.Traverse() if p.IsA(UsdPhysics.RevoluteJoint)]
    assert len(joints) == 6 and all(UsdPhysics.RevoluteJoint(p).GetAxisAttr().Get() == "X" for p in joints)
    drives = [UsdPhysics.DriveAPI(p, "angular") for p in joints]
    per_degree = np.degrees([d.GetDampingAttr().Get() for d in drives])
    np.testing.assert_allclose(per_degree, models.VISCOUS, rtol=SINGLE)
    dry = [p.GetAttribute("physxJointAxis:angular:dynamicFrictionEffort").Get() for p in joints]
    np.testing.assert_allclose(dry, models.COULOMB, rtol=SINGLE)
    assert joints[1].GetAttribute("physxJointAxis:angular:armature").Get() == pytest.approx(1.3)
    masses = [UsdPhysics.MassAPI(p) for p in stage.Traverse() if p.GetName().startswith("link_")]
    expected = robot.chain.masses.copy()
    expected[2] += models.CHANGE[0]
    expected[5] += models.LOAD
    np.testing.assert_allclose([m.GetMassAttr().Get() for m in masses], expected, rtol=SINGLE)
    # The flange stands where the arm has it at zero, and every body where its joint puts it.
    cache = UsdGeom.XformCache()
    flange = next(p for p in stage.Traverse() if p.GetName() == robot.flange)
    matrix = np.array(cache.GetLocalToWorldTransform(flange)).T
    np.testing.assert_allclose(matrix, robot.flange_matrix(np.zeros(6)), atol=1e-9)
    for prim in joints:
        joint = UsdPhysics.RevoluteJoint(prim)
        sides = []
        for rel, at in (
            (joint.GetBody0Rel(), joint.GetLocalPos0Attr()),
            (joint.GetBody1Rel(), joint.GetLocalPos1Attr()),
        ):
            body = stage.GetPrimAtPath(rel.GetTargets()[0])
            sides.append(np.array(cache.GetLocalToWorldTransform(body).Transform(at.Get())))
        np.testing.assert_allclose(*sides, atol=1e-6)
    assert exported.left == ()


@pytest.mark.parametrize("key", ["urdf", "sdf", "usd"])
def test_what_a_target_has_no_place_for_is_listed_with_its_size_in_the_file_too(key, robot):
    effects = (*models.laws(), models.effect("delay", {"driver": "time"}, delay=0.012))
    exported = export_model(robot, models.model(robot, effects), key)
    said = [str(entry) for entry in exported.left]
    assert any("delay" in s and "0.012" in s for s in said)
    assert any("quadratic friction (joint 1)" in s and "1.7" in s for s in said)
    if key != "usd":
        assert any("rotor inertia (joint 1)" in s and "1.1" in s for s in said)
    if key == "urdf":
        assert any("gravity in base" in s and "-9.79" in s for s in said)
        assert any("spring (joint 2)" in s and "25" in s for s in said)
    for line in said:
        assert line in exported.text


def test_every_target_states_its_version():
    for key, form in targets().items():
        assert form.key == key and any(c.isdigit() for c in form.version)


def test_a_sliding_joint_is_written_as_one(tmp_path):
    path = tmp_path / "slide.urdf"
    path.write_text(
        '<robot name="s"><link name="a"/><link name="b"><inertial><mass value="2"/><inertia ixx="0.1" iyy="0.1" '
        'izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link><joint name="j" type="prismatic"><parent link="a"/>'
        '<child link="b"/><axis xyz="0 1 0"/><limit lower="0" upper="1" effort="10" velocity="1"/></joint></robot>'
    )
    slide = load_robot(path)
    for key, words in (
        ("urdf", "prismatic"),
        ("mjcf", 'type="slide"'),
        ("sdf", "prismatic"),
        ("usd", "PrismaticJoint"),
    ):
        assert words in export_model(slide, SavedModel("motion", "slide"), key).text


@pytest.mark.parametrize("key", ["urdf", "mjcf", "sdf", "usd"])
def test_the_command_writes_the_file_and_lists_what_is_not_in_it(key, tmp_path, capsys):
    saved, out = tmp_path / "m.json", tmp_path / f"arm{targets()[key].suffix}"
    save_model(
        SavedModel("motion", "ur10e", (ModelEffect("warmup_friction", {"joint": 1}, {"level": 3.0}),)), saved
    )
    assert run(["export-model", str(saved), "--to", key, str(out)]) == 0
    said = capsys.readouterr().out
    assert str(out) in said and "not carried: warmup_friction (joint 1): level 3" in said
    assert "warmup_friction" in out.read_text()


def test_a_model_of_another_arm_is_refused_in_one_line(tmp_path, capsys):
    saved = tmp_path / "m.json"
    save_model(
        SavedModel("motion", "ur10e", (ModelEffect("rotor_inertia", {"joint": 7}, {"inertia": 1.0}),)), saved
    )
    assert run(["export-model", str(saved), "--to", "mjcf", str(tmp_path / "o.xml")]) == 2
    assert capsys.readouterr().err.count("\n") == 1 and not (tmp_path / "o.xml").exists()
