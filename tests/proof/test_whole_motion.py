"""Logs of arms whose links and joints are none as described: what is drawn, what is true, what could be learnt."""

import json
from dataclasses import replace

import numpy as np
import pytest

from app import catalog
from app.proof.drawing_whole_motion import STRATA, draw_whole_motion
from app.proof.generator.effects.term import Request
from app.proof.generator.motion.cell import drive_torques
from app.proof.generator.motion.making import MotionPlan, make_motion
from app.proof.generator.motion.members import draw_drives
from app.proof.generator.motion.whole import WholeLog, make_whole_log
from app.recordings import read_table

PLAN = MotionPlan(samples=1500, strength=20.0, sharpness=(1e-3, 3e-2))


def arm_of(topology="offset_wrist", seed=3):
    rng = np.random.default_rng(seed)
    family = catalog.member("app.proof.generator.topologies", "TOPOLOGY", topology, what="topology")
    return family.draw(rng), rng


def whole_log(dominant=None, share=0.0, **options):
    arm, rng = arm_of()
    whole = WholeLog(PLAN, PLAN, draw_drives(rng), 0.15, dominant, share, **options)
    return make_whole_log(whole, arm, rng, outside=frozenset(), limit=2.0)


@pytest.mark.parametrize("stratum", sorted(catalog.members(STRATA, "STRATUM")))
def test_a_real_arms_logs_are_the_same_whenever_they_are_drawn(stratum, tmp_path):
    folders = [tmp_path / "a", tmp_path / "b"]
    for folder in folders:
        folder.mkdir()
    answers = [draw_whole_motion(5, 2, stratum, folder) for folder in folders]
    assert json.dumps(answers[0]) == json.dumps(answers[1])
    whole = answers[0]["whole"]
    names = ["case_0002.csv", whole["second"], *([whole["reference"]] if whole["reference"] else [])]
    assert len(names) == (3 if stratum == "log_reference" else 2)
    for name in names:
        assert (folders[0] / name).read_bytes() == (folders[1] / name).read_bytes()
        table = read_table(folders[0] / name)
        assert table.kind == "motion" and table.has("t", "q6")
    assert {m["effect"] for m in whole["members"]} >= {
        "coulomb_friction",
        "viscous_friction",
        "rotor_inertia",
    }


def test_shares_are_what_is_lost_without_a_family_and_none_is_forgotten():
    made = whole_log()
    cell, terms = made.first.cell, [m.term for m in made.members]
    described = replace(cell, arm=cell.described)
    before = np.mean((drive_torques(cell, terms) - described.rigid) ** 2)
    without = [t for t in terms if t.effect != "rotor_inertia"]
    lost = np.mean((drive_torques(cell, terms) - drive_torques(cell, without)) ** 2)
    assert made.shares["rotors"] == pytest.approx(lost / before)
    assert made.shares["inertials"] > 0.0 and made.shares["friction"] > 0.0


def test_a_dominant_law_has_the_share_it_was_drawn_for():
    made = whole_log(Request("joint_spring", {"joint": 3}), 0.8)
    assert made.members[-1].term.effect == "joint_spring" and abs(made.dominant_share - 0.8) < 0.25
    assert made.norm > 15 and made.lookalikes == () and made.value_sd < 0.08


def test_the_oracle_is_hardly_worse_than_the_noise_on_a_log_it_has_not_seen():
    made = whole_log()
    assert made.floor < made.oracle < 1.2 * made.floor


def test_a_reference_lacks_the_load_and_nothing_else():
    made = whole_log(Request("payload"), 0.5, referenced=True)
    there = made.reference.cell
    assert np.array_equal(there.standstill, made.first.cell.standstill)
    before = [m.term for m in made.members[:-1]]
    left = made.reference.torque - drive_torques(there, before)
    assert np.all(np.std(left, axis=0) < 1.3 * made.reference.sigma)
    unchanged = whole_log(referenced=True)
    left = unchanged.reference.torque - drive_torques(
        unchanged.reference.cell, [m.term for m in unchanged.members]
    )
    assert np.all(np.std(left, axis=0) < 1.3 * unchanged.reference.sigma)


def test_one_factor_for_all_torques_is_no_joints():
    arm, rng = arm_of()
    made = make_motion(PLAN, arm, arm, [Request("torque_constant", {"common": True}, {"scale": 0.3})], rng)
    assert dict(made.terms[0].where) == {}
    assert np.allclose(drive_torques(made.cell, made.terms), 1.3 * drive_torques(made.cell, ()))


def test_a_heavier_link_weighs_on_the_joints_before_it_only():
    arm, rng = arm_of()
    made = make_motion(PLAN, arm, arm, [Request("link_inertia", {"link": 3}, {"mass": 1.0})], rng)
    added = drive_torques(made.cell, made.terms) - drive_torques(made.cell, ())
    assert np.abs(added[:, 3:]).max() < 1e-9 < 0.1 < np.abs(added[:, 1]).max()


def test_dry_friction_fades_as_each_joint_has_it():
    arm, _ = arm_of()
    made = make_motion(replace(PLAN, fading="arctan"), arm, arm, [], np.random.default_rng(2))
    cell = made.cell
    assert cell.standstill.shape == (6,) and np.ptp(cell.standstill) > 1e-3
    wanted = 2 / np.pi * np.arctan(0.5 * np.pi * cell.qd / cell.standstill)
    assert np.allclose(cell.direction, wanted)


def test_a_poor_recorder_leaves_gaps_spikes_and_samples_that_repeat():
    arm, _ = arm_of()
    plan = replace(PLAN, spikes=0.01, stale=0.1, gaps=3, staircase=0.05)
    made = make_motion(plan, arm, arm, [], np.random.default_rng(2))
    left = (made.torque - drive_torques(made.cell, ())) / made.sigma
    assert len(made.q) == made.cell.m < plan.samples
    assert 0.003 < np.mean(np.abs(left) > 7) < 0.05
    assert 0.05 < np.mean(np.all(np.diff(made.torque, axis=0) == 0, axis=1)) < 0.2
    assert np.allclose(np.rint(made.qd / 0.05) * 0.05, made.qd)
