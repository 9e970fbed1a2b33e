"""`teachframe simulate --model`: what a diagnosis found is simulated, and found again."""

import json

import numpy as np
import pytest

from app import catalog
from app.diagnosis.model import ModelEffect, SavedModel, load_model, save_model
from app.errors import InputError
from app.proof.generator.effects.term import Request
from app.proof.generator.motion.making import MotionPlan, make_motion
from app.proof.generator.static.making import Plan, make
from app.proof.generator.urdf import find_robot, read_arm
from app.proof.held import terms_of
from tests.cli.running import assert_one_line, teachframe

SIGMAS = 4.0  # two independent estimates of one value; wider than this is another value
STATIC = sorted(set(catalog.members("app.proof.generator.effects.static", "EFFECT")) - {"wrong_convention"})
MOTION = sorted(catalog.members("app.proof.generator.effects.motion", "EFFECT"))


def ur10e():
    return read_arm(find_robot("ur10e"))


@pytest.mark.parametrize("key", STATIC)
def test_a_saved_static_effect_is_the_term_it_was_learnt_from(key):
    kind = "touch" if key == "touch_indentation" else "tracker"
    plan = Plan(kind=kind, samples=24, declares_compliance=True)
    term = make(plan, ur10e(), ur10e(), [Request(key)], np.random.default_rng(1)).terms[0]
    model = SavedModel("static", "ur10e", (ModelEffect(key, dict(term.where), dict(term.parameters)),))
    (again,), left_out = terms_of(model, kind, "ur10e", samples=24)
    assert not left_out
    assert again.where == term.where and again.parameters == term.parameters


@pytest.mark.parametrize("key", MOTION)
def test_a_saved_motion_effect_is_the_term_it_was_learnt_from(key):
    made = make_motion(MotionPlan(samples=500), ur10e(), ur10e(), [Request(key)], np.random.default_rng(1))
    term = made.terms[0]
    model = SavedModel("motion", "ur10e", (ModelEffect(key, dict(term.where), dict(term.parameters)),))
    (again,), left_out = terms_of(model, "motion", "ur10e", samples=500, seconds=4.0)
    assert not left_out
    assert again.where == term.where and again.parameters == term.parameters


@pytest.mark.parametrize(
    "kind, effect",
    [
        ("tracker", "joint_compliance:joint=2"),
        ("tracker", "base_shift:from_row=31"),
        ("touch", "joint_zero:joint=3"),
        ("motion", "coulomb_friction:joint=2"),
    ],
)
def test_a_simulation_with_the_saved_model_shows_the_same_law_and_value(kind, effect, tmp_path):
    first, again, model = tmp_path / "first.csv", tmp_path / "again.csv", tmp_path / "model.json"
    common = ("--robot", "ur10e", "--kind", kind)
    assert teachframe("simulate", first, *common, "--effect", effect, "--seed", "3").code == 0
    found = json.loads(teachframe("diagnose", first, "--json", "--save-model", model).out)["findings"]
    said = teachframe("simulate", again, *common, "--model", model, "--seed", "8")
    assert said.code == 0, said.err
    found_again = json.loads(teachframe("diagnose", again, "--json").out)["findings"]
    assert [(f["effect"], f["where"]) for f in found] == [(f["effect"], f["where"]) for f in found_again]
    assert found
    for a, b in zip(found, found_again, strict=True):
        for p, r in zip(a["parameters"], b["parameters"], strict=True):
            assert abs(p["value"] - r["value"]) < SIGMAS * np.hypot(p["std"], r["std"])


def test_a_turned_base_turns_every_measured_point_about_the_bases_origin():
    angle = 0.01
    where, values = {"body": "base", "from_row": 2}, {"dx": 0.0, "dy": 0.0, "dz": 0.0, "rz": angle}
    model = SavedModel("static", "ur10e", (ModelEffect("base_shift", where, values),))
    held, _ = terms_of(model, "tracker", "ur10e", samples=12)
    plan = Plan(samples=12, noise=1e-12)
    bare = make(plan, ur10e(), ur10e(), [], np.random.default_rng(1))
    turned = make(plan, ur10e(), ur10e(), [], np.random.default_rng(1), held=held)
    into_base = np.linalg.inv(bare.cell.views[0])
    before, after = (made.points[:, 0] @ into_base[:3, :3].T + into_base[:3, 3] for made in (bare, turned))
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    assert np.allclose(after[0], before[0], atol=1e-9)
    assert np.allclose(after[1:], before[1:] @ turn.T, atol=1e-9)


def test_what_a_recording_cannot_carry_is_said(tmp_path):
    model = SavedModel(
        "static",
        "ur10e",
        (
            ModelEffect("joint_slip", {"joint": 2, "from_row": 500}, {"step": 1e-3}),
            ModelEffect("joint_drift", {"joint": 2, "driver": "temperature"}, {"rate": 1e-3}),
            ModelEffect("joint_zero", {"joint": 2}, {"offset": 1e-3}),
        ),
    )
    save_model(model, tmp_path / "m.json")
    out = tmp_path / "out.csv"
    common = ("--robot", "ur10e", "--kind", "tracker", "--model", tmp_path / "m.json")
    said = teachframe("simulate", out, *common)
    assert said.code == 0
    assert "left out of the simulation: joint_slip (it begins at row 500 of 60)" in said.err
    assert "left out of the simulation: joint_drift (no temperature is simulated)" in said.err
    truth = json.loads((tmp_path / "out.truth.json").read_text())
    assert [e["effect"] for e in truth["effects"]] == ["joint_zero"]


def test_a_model_of_another_arm_or_kind_is_refused(tmp_path):
    model = SavedModel("static", "iiwa7", (ModelEffect("joint_zero", {"joint": 7}, {"offset": 1e-3}),))
    save_model(model, tmp_path / "m.json")
    out = ("simulate", tmp_path / "out.csv", "--robot", "ur10e", "--model", tmp_path / "m.json")
    assert_one_line(teachframe(*out, "--kind", "tracker"), "m.json", "joint 7", "ur10e has 6 joints", "iiwa7")
    assert_one_line(teachframe(*out, "--kind", "motion"), "m.json", "static", "expected")
    with pytest.raises(InputError):
        terms_of(
            SavedModel("static", "ur10e", (ModelEffect("telepathy", {}, {}),)), "touch", "ur10e", samples=9
        )


def test_a_hand_that_the_arm_has_not_is_a_load_below_nothing_in_a_log_and_in_a_log_only(tmp_path):
    hand = ModelEffect("payload", {"body": "tool"}, {"mass": -0.8, "com_x": 0.0, "com_y": 0.0, "com_z": 0.05})
    save_model(SavedModel("motion", "ur10e", (hand,)), tmp_path / "log.json")
    assert load_model(tmp_path / "log.json").effects == (hand,)
    with pytest.raises(InputError):
        save_model(SavedModel("static", "ur10e", (hand,)), tmp_path / "touch.json")
        load_model(tmp_path / "touch.json")


def test_what_holds_for_one_log_only_is_left_out_of_a_simulation_and_said():
    rest = ModelEffect("rest_friction", {"joint": 2, "from_s": 0.0, "to_s": 2.0}, {"level": 3.0})
    curve = ModelEffect("smooth_torque", {"joint": 1, "driver": "speed"}, {"height1": 1.0})
    terms, left_out = terms_of(
        SavedModel("motion", "ur10e", (rest, curve)), "motion", "ur10e", samples=500, seconds=4.0
    )
    assert not terms
    assert ["rest_friction" in left_out[0], "smooth_torque" in left_out[1]] == [True, True]


def test_a_twist_that_was_learnt_without_masses_is_left_out_of_a_simulation():
    told = {"inertia": 0.8, "resonance": 9.4, "damping_ratio": 0.05}
    model = SavedModel("motion", "ur10e", (ModelEffect("elastic_joint", {"joint": 2}, told),))
    terms, (left_out,) = terms_of(model, "motion", "ur10e", samples=500, seconds=4.0)
    assert not terms and "elastic_joint" in left_out and "stiffness" in left_out
