"""`teachframe simulate`: what it writes, and what it keeps to itself."""

import json

import numpy as np
import pytest

from app import catalog
from app.cli import run
from app.recordings import read_table
from tests.proof.arms import random_arm

STATIC = sorted(catalog.members("app.proof.generator.effects.static", "EFFECT"))
ONLY_TOUCH = {"touch_indentation"}
ONLY_TRACKER = {"instrument_zero_shift"}
STRENGTH = 0.05  # mm; how far an effect may be from the strength it was drawn for
FIXED_STRENGTH = {"wrong_convention", "payload"}


def simulate(folder, *options, name="out.csv", topology="spherical_wrist"):
    _, robot = random_arm(topology, folder, 5)
    return run(["simulate", "--robot", str(robot), *options, str(folder / name)])


@pytest.mark.parametrize("effect", STATIC)
@pytest.mark.parametrize("kind", ["touch", "tracker"])
def test_every_static_effect_makes_a_recording_of_the_contracts_form(kind, effect, tmp_path, capsys):
    code = simulate(tmp_path, "--kind", kind, "--effect", effect, "--seed", "3")
    if effect in (ONLY_TOUCH if kind == "tracker" else ONLY_TRACKER):
        assert code == 2
        assert len(capsys.readouterr().err.strip().splitlines()) == 1
        return
    assert code == 0
    table = read_table(tmp_path / "out.csv")
    truth = json.loads((tmp_path / "out.truth.json").read_text())
    assert table.kind == kind and table.keys["noise_mm"] == 0.15 and len(table) == 60
    assert np.isfinite(table.numbers([f"q{j + 1}" for j in range(6)])).all()
    assert [e["effect"] for e in truth["effects"]] == [effect]
    if effect not in FIXED_STRENGTH:
        assert abs(truth["effects"][0]["raw_rms_mm"] - 0.8) < STRENGTH


def test_the_truth_stands_in_the_truth_file_and_in_nothing_else(tmp_path):
    simulate(tmp_path, "--kind", "tracker", "--effect", "joint_compliance:joint=2", "--seed", "3")
    text = (tmp_path / "out.csv").read_text()
    truth = json.loads((tmp_path / "out.truth.json").read_text())
    header = [line for line in text.splitlines() if line.startswith("#")]
    assert [line.split(":")[0] for line in header] == ["# kind", "# robot", "# noise_mm"]
    assert "compliance" not in text and "seed" not in text and "effect" not in text
    names = {p.name for p in tmp_path.iterdir()}
    assert names == {"out.csv", "out.truth.json", "spherical_wrist_5.urdf"}
    assert truth["effects"][0]["where"] == {"joint": 2, "driver": "gravity_torque"}


def test_a_header_of_a_faulty_recording_is_the_header_of_a_clean_one(tmp_path):
    simulate(tmp_path, "--kind", "touch", "--seed", "3", name="clean.csv")
    simulate(tmp_path, "--kind", "touch", "--effect", "joint_zero:joint=3", "--seed", "3", name="bad.csv")
    clean, bad = ((tmp_path / n).read_text().splitlines() for n in ("clean.csv", "bad.csv"))
    assert clean[:4] == bad[:4] and clean[4:] != bad[4:]


@pytest.mark.parametrize("kind", ["touch", "tracker"])
def test_the_same_seed_writes_the_same_file_and_another_seed_another(kind, tmp_path):
    options = ["--kind", kind, "--effect", "gear_eccentricity"]
    simulate(tmp_path, *options, "--seed", "8", name="a.csv")
    simulate(tmp_path, *options, "--seed", "8", name="b.csv")
    simulate(tmp_path, *options, "--seed", "9", name="c.csv")
    a, b, c = ((tmp_path / f"{n}.csv").read_bytes() for n in "abc")
    assert a == b != c


@pytest.mark.parametrize(
    ("option", "told"),
    [
        ("joint_zer", "joint_zero"),
        ("joint_zero:link=2", "joint="),
        ("joint_zero:joint=two", "whole number"),
        ("joint_zero:joint=9", "one of 1, 2, 3, 4, 5, 6"),
        ("joint_zero:offset=big", "a number"),
        ("link_length:axis=alpha", "one of a, d"),
        ("base_shift:from_row=900", "2 to 60"),
    ],
)
def test_an_effect_that_cannot_be_is_refused_in_one_line(option, told, tmp_path, capsys):
    assert simulate(tmp_path, "--kind", "tracker", "--effect", option) == 2
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 1 and told in lines[0]
    assert not (tmp_path / "out.csv").exists()


def test_sizes_are_taken_in_the_units_people_use(tmp_path):
    simulate(tmp_path, "--kind", "tracker", "--effect", "joint_zero:joint=3,size=0.1")
    truth = json.loads((tmp_path / "out.truth.json").read_text())
    assert truth["effects"][0]["parameters"]["offset"] == pytest.approx(np.radians(0.1))
    simulate(tmp_path, "--kind", "tracker", "--effect", "tool_slip:from_row=20,size=1/0/-2")
    truth = json.loads((tmp_path / "out.truth.json").read_text())
    assert truth["effects"][0]["parameters"] == pytest.approx({"dx": 1e-3, "dy": 0.0, "dz": -2e-3})


def test_a_touch_with_a_hidden_zero_really_touches(tmp_path):
    """With the true zero put back, all touches of a target meet in one point; without it they do not."""
    from app.kinematics import load_robot

    arm, robot = random_arm("spherical_wrist", tmp_path, 5)
    simulate(tmp_path, "--kind", "touch", "--effect", "joint_zero:joint=3", "--noise-mm", "0.001")
    truth = json.loads((tmp_path / "out.truth.json").read_text())
    table = read_table(tmp_path / "out.csv")
    q = table.numbers([f"q{j + 1}" for j in range(6)])
    model, tip = load_robot(robot), np.array(truth["tools_mm"][0][0]) / 1e3
    target = np.array(table.text("target"))

    def worst(angles):
        points = np.array([(m := model.flange_matrix(row))[:3, :3] @ tip + m[:3, 3] for row in angles])
        return max(np.ptp(points[target == t], axis=0).max() for t in set(target))

    put_right = q.copy()
    put_right[:, 2] += truth["effects"][0]["parameters"]["offset"]
    assert worst(put_right) < 2e-5 < 2e-4 < worst(q)
    assert arm.n == 6


def test_all_kinds_of_tracker_columns_are_written(tmp_path):
    options = ["--reflectors", "3", "--orientation", "--sessions", "2", "--torque-sensors", "--repeats", "8"]
    assert simulate(tmp_path, "--kind", "tracker", *options, "--loads-kg", "0", "4") == 0
    table = read_table(tmp_path / "out.csv")
    assert table.has("x", "y3", "z2", "qw", "tau6", "payload", "pose", "session", "t")
    assert set(table.text("session")) == {"S1", "S2"} and len(set(table.text("pose"))) == 52
    assert simulate(tmp_path, "--kind", "tracker", "--wire") == 0
    assert read_table(tmp_path / "out.csv").has("length")


@pytest.mark.parametrize(
    ("options", "shown"),
    [
        ("joint=2", lambda q: q * [1, -1, 1, 1, 1, 1]),
        ("joint=2,turn=90", lambda q: np.add(q, [0, np.pi / 2, 0, 0, 0, 0])),
        ("joint=2,source_joint=4", lambda q: q[:, [0, 3, 2, 1, 4, 5]]),
    ],
)
def test_a_wrong_convention_puts_the_tool_where_the_right_one_would(options, shown, tmp_path):
    from app.kinematics import load_robot

    _, robot = random_arm("spherical_wrist", tmp_path, 5)
    simulate(tmp_path, "--kind", "tracker", "--effect", f"wrong_convention:{options}", "--noise-mm", "0.0001")
    truth, table = json.loads((tmp_path / "out.truth.json").read_text()), read_table(tmp_path / "out.csv")
    q, seen = table.numbers([f"q{j + 1}" for j in range(6)]), table.numbers("xyz")
    model, tip = load_robot(robot), np.array(truth["tools_mm"][0][0]) / 1e3
    points = np.array([(m := model.flange_matrix(row))[:3, :3] @ tip + m[:3, 3] for row in shown(q)])

    def distances(p):
        return np.linalg.norm(p[:, None] - p[None], axis=-1)

    assert np.abs(distances(points) - distances(seen)).max() < 2e-6
