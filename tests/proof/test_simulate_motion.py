"""`teachframe simulate --kind motion`: joint logs with known effects."""

import json

import numpy as np
import pinocchio as pin
import pytest

from app import catalog
from app.cli import run
from app.kinematics import load_robot
from app.proof.drawing_motion import draw_motion
from app.proof.generator.motion.making import MotionPlan, make_motion
from app.proof.generator.urdf import read_arm
from app.recordings import read_table
from tests.proof.arms import TOPOLOGIES, random_arm

MOTION = sorted(catalog.members("app.proof.generator.effects.motion", "EFFECT"))
STRENGTH = 4.0  # times the noise, where an effect's strength is left open
SAME_TORQUE = 1e-8  # Nm
SLOPE = 1e-4  # relative; differences of the path against its own derivative


def simulate(folder, *options, name="out.csv", topology="offset_wrist"):
    _, robot = random_arm(topology, folder, 5)
    arguments = ["simulate", "--robot", str(robot), "--kind", "motion", "--samples", "500", *options]
    return run([*arguments, str(folder / name)])


@pytest.mark.parametrize("effect", MOTION)
def test_every_motion_effect_makes_a_log_of_the_contracts_form(effect, tmp_path):
    assert simulate(tmp_path, "--effect", effect, "--seed", "3") == 0
    table = read_table(tmp_path / "out.csv")
    truth = json.loads((tmp_path / "out.truth.json").read_text())
    assert table.kind == "motion" and len(table) == 500 and len(table.keys["noise_Nm"]) == 6
    assert table.has("t", "q6", "qd6", "tau6")
    (said,) = truth["effects"]
    assert said["effect"] == effect
    assert max(np.divide(said["raw_rms_Nm"], truth["noise_Nm"])) > 0.2


def test_the_truth_of_a_log_stands_in_the_truth_file_only(tmp_path):
    simulate(tmp_path, "--effect", "coulomb_friction:joint=2", "--seed", "3")
    text = (tmp_path / "out.csv").read_text()
    keys = [line.split(":")[0] for line in text.splitlines() if line.startswith("#")]
    assert keys == ["# kind", "# robot", "# noise_Nm"] and "coulomb" not in text
    assert json.loads((tmp_path / "out.truth.json").read_text())["effects"][0]["where"]["joint"] == 2


def test_the_same_seed_writes_the_same_log(tmp_path):
    for name in ("a", "b"):
        simulate(tmp_path, "--effect", "contact", "--seed", "8", name=f"{name}.csv")
    simulate(tmp_path, "--effect", "contact", "--seed", "9", name="c.csv")
    a, b, c = ((tmp_path / f"{n}.csv").read_bytes() for n in "abc")
    assert a == b != c


def test_currents_are_torques_over_the_stated_gains(tmp_path):
    simulate(tmp_path, "--seed", "4", name="tau.csv")
    simulate(tmp_path, "--seed", "4", "--currents", name="amps.csv")
    tau, amps = read_table(tmp_path / "tau.csv"), read_table(tmp_path / "amps.csv")
    gains = np.array(amps.keys["drive_gain_Nm_per_A"])
    joints = range(1, 7)
    torque = tau.numbers([f"tau{j}" for j in joints])
    assert np.abs(amps.numbers([f"i{j}" for j in joints]) * gains - torque).max() < 1e-4


@pytest.mark.parametrize("topology", TOPOLOGIES)
def test_a_log_without_effects_is_what_pin_computes_from_the_description(topology, tmp_path):
    _, path = random_arm(topology, tmp_path, 2)
    arm, robot = read_arm(path), load_robot(path)
    plan = MotionPlan(samples=200, noise=1e-12)
    made = make_motion(plan, arm, arm, [], np.random.default_rng(2))
    q, qd, qdd = made.cell.state
    for i in range(0, 200, 20):
        torque = pin.rnea(robot.model, robot.data, q[i], qd[i], qdd[i])
        assert np.abs(made.torque[i] - torque).max() < SAME_TORQUE


@pytest.mark.parametrize("seed", range(12))
def test_trajectories_stay_within_limits_and_their_derivatives_are_exact(seed, tmp_path):
    _, path = random_arm("spherical_wrist", tmp_path, 2)
    arm = read_arm(path)
    made = make_motion(MotionPlan(samples=1500), arm, arm, [], np.random.default_rng(seed))
    q, qd, qdd = made.cell.state
    assert np.all((q >= arm.lower) & (q <= arm.upper)) and np.all(np.abs(qd) <= arm.speed)
    step = 1e-5
    ahead, back = (made.cell.path(made.cell.t[5:-5] + s) for s in (step, -step))
    assert np.abs((ahead[0] - back[0]) / (2 * step) - qd[5:-5]).max() < SLOPE * max(1.0, np.abs(qd).max())
    # accelerations of moves from stop to stop have corners in their slope, not in themselves
    assert np.abs((ahead[1] - back[1]) / (2 * step) - qdd[5:-5]).max() < 1e-2 * max(1.0, np.abs(qdd).max())


@pytest.mark.parametrize(
    ("option", "told"),
    [
        ("friction", "coulomb_friction"),
        ("contact:from_s=99", "0.00 to"),
        ("coulomb_friction:joint=7", "one of"),
    ],
)
def test_a_motion_effect_that_cannot_be_is_refused_in_one_line(option, told, tmp_path, capsys):
    assert simulate(tmp_path, "--effect", option) == 2
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 1 and told in lines[0]


@pytest.mark.parametrize("sizes", ["stiffness=-5", "damping=20", "stiffness=9000,damping=-1", "stiffness=1"])
def test_a_spring_that_cannot_be_is_refused_in_a_line(sizes, tmp_path, capsys):
    assert simulate(tmp_path, "--effect", f"elastic_joint:joint=2,{sizes}") == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert "elastic_joint" in line and "stiffness" in line


def test_a_rival_that_this_arm_cannot_have_stops_no_drawing(tmp_path):
    """A spring behind joint 6 of this case's arm would not hold what hangs on it: it is no rival there."""
    assert draw_motion(20261205, 16, "elastic", tmp_path)["truth"]
