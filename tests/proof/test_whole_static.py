"""Arms that are off everywhere: what is drawn, what is true of it, and what could be learnt."""

import json
from dataclasses import replace

import numpy as np
import pytest

from app import catalog
from app.diagnosis.judging import judge
from app.diagnosis.model import ModelEffect, SavedModel
from app.kinematics import load_robot
from app.proof.drawing_whole import STRATA, draw_whole_static
from app.proof.generator.effects.term import Request
from app.proof.generator.files import write_static
from app.proof.generator.observer import carried_rms, informed_error, oracle_error
from app.proof.generator.static.cell import world_with
from app.proof.generator.static.columns import places, term_columns
from app.proof.generator.static.linear import Levers
from app.proof.generator.static.making import Plan, make
from app.proof.generator.static.members import draw_build
from app.proof.generator.static.whole import Whole, linear_of, make_whole
from app.proof.generator.urdf_writing import write_arm
from app.recordings import read_table

LEVERS = 1e-3  # of the largest change; differences of the exact model round to about this
KINDS = [
    {"kind": "tracker", "reflectors": 2, "sessions": 2},
    {"kind": "touch", "known_targets": True},
    {"kind": "tracker", "wire": True},
]


def arm_of(topology, seed=3):
    rng = np.random.default_rng(seed)
    family = catalog.member("app.proof.generator.topologies", "TOPOLOGY", topology, what="topology")
    return family.draw(rng), rng


def whole_arm(plan, dominant=None, share=0.0, topology="offset_wrist", seed=3):
    arm, rng = arm_of(topology, seed)
    whole = Whole(plan, plan, draw_build(rng), dominant, share)
    return make_whole(whole, arm, rng, outside=frozenset(), limit=2.0)


@pytest.mark.parametrize("plan", KINDS, ids=lambda p: "-".join(map(str, p.values())))
def test_levers_say_what_differences_of_the_exact_model_say(plan):
    arm, rng = arm_of("offset_wrist")
    made = make(
        Plan(samples=24, noise=1e-6, **plan), arm, arm, [Request("joint_compliance", {"joint": 2})], rng
    )
    levers = Levers(made)
    for term in places(made):
        if term.effect != "payload":
            exact, ours = term_columns(made, made.terms, term), levers.columns([term])
            assert np.abs(exact - ours).max() <= LEVERS * max(np.abs(exact).max(), 1e-9), term


@pytest.mark.parametrize("stratum", sorted(catalog.members(STRATA, "STRATUM")))
def test_a_real_arm_is_two_recordings_and_the_same_whenever_it_is_drawn(stratum, tmp_path):
    folders = [tmp_path / "a", tmp_path / "b"]
    for folder in folders:
        folder.mkdir()
    answers = [draw_whole_static(5, 2, stratum, folder) for folder in folders]
    assert json.dumps(answers[0]) == json.dumps(answers[1])
    whole = answers[0]["whole"]
    for name in ("case_0002.csv", whole["second"]):
        assert (folders[0] / name).read_bytes() == (folders[1] / name).read_bytes()
        assert read_table(folders[0] / name).kind in ("touch", "tracker")
    assert {m["effect"] for m in whole["members"]} >= {
        "joint_zero",
        "link_length",
        "backlash",
        "joint_compliance",
    }
    assert whole["informed"] is None or whole["informed"] > 0.8 * whole["floor"]
    assert not list(folders[0].glob("*.json"))


def test_a_dominant_effect_has_the_share_it_was_drawn_for_and_its_family_has_it_too():
    plan = Plan(samples=100, noise=0.05e-3, effect_rms=2e-3)
    made = whole_arm(plan, Request("backlash", {"joint": 3, "driver": "approach"}), 0.8)
    assert made.members[-1].term.effect == "backlash"
    assert abs(made.dominant_share - 0.8) < 0.1
    share, sigma = made.shares["play"]
    assert abs(share - made.dominant_share) < 0.05 and sigma < 0.05
    assert made.norm > 15 and made.lookalikes == ()


def test_a_family_without_a_share_is_told_from_one_that_has_it():
    made = whole_arm(Plan(samples=100, noise=0.05e-3))
    shares = {family: share for family, (share, _) in made.shares.items()}
    assert shares["zeros"] + shares["geometry"] > 0.5 and max(shares.values()) > 0.3
    assert all(share > -1e-9 for share in shares.values())


def test_a_joints_zero_and_the_twist_across_its_link_are_one_class_between_axes_that_cross():
    plan = Plan(samples=100, noise=0.05e-3, effect_rms=2e-3)
    made = whole_arm(plan, Request("joint_zero", {"joint": 3}), 0.8, topology="seven_axes")
    assert ("link_twist", 3, "beta") in [
        (a["effect"], a["where"].get("link"), a["where"].get("axis")) for a in made.lookalikes
    ]


@pytest.mark.parametrize("kind", ["tracker", "touch"])
def test_the_oracle_is_ordinary_least_squares_and_the_informed_observer_is_no_worse(kind):
    made = whole_arm(Plan(kind=kind, samples=120, noise=0.05e-3))
    terms = [m.term for m in made.members]
    first, second = (linear_of(Levers(run), terms) for run in (made.first, made.second))
    off = oracle_error(first)
    left = first.freed(first.error - first.columns @ off)
    assert np.abs(first.columns.T @ left).max() < 1e-6 * np.abs(first.columns).max() * len(left)
    values = np.array([v for t in terms for v in t.parameters.values()])
    widths = np.array([m.width for m in made.members for _ in m.term.parameters])
    informed = carried_rms(second, informed_error(first, values, widths))
    assert carried_rms(second, 0 * off) < informed < carried_rms(second, off) * 1.02


def test_the_oracles_model_does_on_the_exact_second_run_what_was_reckoned_with_levers():
    made = whole_arm(Plan(samples=150, noise=0.05e-3))
    terms = [m.term for m in made.members]
    off = iter(oracle_error(linear_of(Levers(made.first), terms)))
    guess = [type(t)(t.effect, t.where, {k: v + next(off) for k, v in t.parameters.items()}) for t in terms]
    levers = Levers(made.second)
    linear = linear_of(levers, terms)
    left = linear.freed(levers.missing(guess).ravel() + linear.error)
    assert made.oracle == pytest.approx(made.second.plan.noise * np.sqrt(np.mean(left**2)), rel=0.02)


def test_a_repeated_pose_is_come_to_from_either_side():
    plan = Plan(samples=60, repeats=8, repeats_as="either_side")
    made = make(plan, *[arm_of("offset_wrist")[0]] * 2, [], np.random.default_rng(1))
    pose, move = made.pose, made.cell.last_move
    twice = [np.flatnonzero(pose == p) for p in np.unique(pose) if np.sum(pose == p) == 2]
    assert len(twice) == 8
    for first, second in twice:
        assert np.array_equal(made.cell.q[first], made.cell.q[second])
        assert np.all(move[first] == -move[second])


def test_a_step_that_settles_takes_its_rows_and_one_that_does_not_is_whole_at_once():
    arm, _ = arm_of("offset_wrist")
    for settling, wanted in ((0, [0.0, 1.0, 1.0, 1.0]), (2, [0.0, 1 / 3, 2 / 3, 1.0])):
        plan = Plan(samples=40, settling=settling)
        request = Request("joint_slip", {"joint": 2, "from_row": 20}, {"step": 1.0e-3})
        made = make(plan, arm, arm, [request], np.random.default_rng(2))
        assert world_with(made.cell, made.terms).dq[18:22, 1] == pytest.approx(1e-3 * np.array(wanted))


@pytest.mark.parametrize("plan", KINDS, ids=lambda p: "-".join(map(str, p.values())))
def test_the_truth_saved_as_a_model_leaves_the_noise_of_the_second_run(plan, tmp_path):
    """Written apart, generator and library mean the same by every name, sign and unit."""
    arm, rng = arm_of("spherical_wrist")
    run = Plan(samples=90, noise=0.05e-3, **plan)
    build = replace(draw_build(rng), second_waves=0.0)
    made = make_whole(Whole(run, run, build), arm, rng, outside=frozenset(), limit=2.0)
    write_arm(arm.changed(name="true"), tmp_path / "true.urdf")
    write_static(made.second, tmp_path / "second.csv", "true.urdf")
    effects = tuple(ModelEffect(t.effect, dict(t.where), dict(t.parameters)) for t in made.second.terms)
    told = judge(
        read_table(tmp_path / "second.csv"),
        load_robot(tmp_path / "true.urdf"),
        SavedModel("static", "true", effects),
    )
    left = {step: quality.fit_rms for step, quality in told.steps.items()}
    assert left["with the model"] == pytest.approx(0.05, rel=0.15)
    assert left["description alone"] > 3 * left["with the model"]
