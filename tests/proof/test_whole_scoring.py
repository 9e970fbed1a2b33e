"""The rules by which an answer about an arm that is off everywhere is right or wrong."""

import pytest

from app import catalog
from app.proof.drawing_whole import STRATA as STATIC
from app.proof.drawing_whole import draw_whole_static
from app.proof.drawing_whole_motion import STRATA as MOTION
from app.proof.drawing_whole_motion import draw_whole_motion
from app.proof.scoring import score
from app.proof.verdicts import judge

PLAY = {"effect": "backlash", "where": {"joint": 3, "driver": "approach"}, "parameters": {"gap": 1e-3}}
WAVE = {
    "effect": "gear_eccentricity",
    "where": {"joint": 2, "order": 2},
    "parameters": {"sin": 2e-4, "cos": 1e-4},
}


def answer(**changes):
    truth = {
        **PLAY,
        "survives": 9.0,
        "norm": 150.0,
        "nearest": 90.0,
        "lookalikes": [],
        "share": 0.8,
        "value_sd": 0.01,
    }
    whole = {
        "members": [{**WAVE, "norm": 30.0}, {**PLAY, "norm": 150.0}],
        "families": {"play": {"share": 0.8, "sigma": 0.01}, "gears": {"share": 0.15, "sigma": 0.01}},
        "shared_out": [],
        "settled": True,
        "masses": 0.0,
        "oracle": 0.10,
        "informed": 0.08,
    }
    case = {"id": "case_0000", "stratum": "arm_play", "topology": "offset_wrist", "kind": "tracker"}
    return {**case, "noise_mm": 0.05, "outlier_rows": [], "truth": [truth], "whole": {**whole, **changes}}


def finding(effect="backlash", where=None, value=0.0573, std=0.0005, name="gap"):
    where = PLAY["where"] if where is None else where
    parameters = [{"name": name, "value": value, "std": std, "unit": "deg"}]
    return {"effect": effect, "where": where, "parameters": parameters, "alternatives": []}


def said(*findings, second=0.11, again=0.05, play=0.78, gears=0.15, verdict="named"):
    families = [{"family": "play", "share": play}, {"family": "gears", "share": gears}]
    return {
        "verdict": verdict,
        "findings": list(findings or [finding()]),
        "after": {"fit_rms": 0.05, "heldout_rms": 0.055, "unit": "mm"},
        "families": families,
        "whole": {"self": {"fit_rms": again}, "second": {"fit_rms": second}},
    }


def judged(told, outside=frozenset(), **changes):
    return judge(answer(**changes), told, outside).whole


def test_a_right_answer_misses_nothing():
    whole = judged(said())
    assert whole.misses == [] and whole.name and whole.place and whole.value
    assert whole.transfer == pytest.approx(1.1) and whole.over_best == pytest.approx(1.375)


def test_a_model_that_does_not_keep_what_after_says_is_found_out():
    assert judged(said(again=0.0504)).consistent
    assert judged(said(again=0.051)).consistent is False
    assert judged(said(again=0.049)).consistent is False


def test_a_refusal_of_the_second_run_is_no_transfer():
    told = said()
    told["whole"]["second"] = None
    assert judged(told).transfer == float("inf")
    assert judged(said(), oracle=None).transfer is None


@pytest.mark.parametrize(
    ("value", "std", "right"),
    [
        (0.0573, 0.0005, True),
        (0.0573 * 1.3, 0.01, False),
        (0.0573 * 1.2, 0.0005, False),
        (0.0573 * 1.2, 0.006, True),
    ],
)
def test_a_value_is_right_within_a_quarter_and_three_of_its_deviations(value, std, right):
    assert judged(said(finding(value=value, std=std))).value is right


def test_a_value_nobody_could_know_is_not_asked_for():
    case = answer()
    case["truth"][0]["value_sd"] = 0.2
    assert judge(case, said(finding(value=0.1))).whole.value is None


def test_a_share_is_right_within_ten_points_and_asked_for_only_where_it_can_be_told():
    assert not any("share" in m for m in judged(said(play=0.71)).misses)
    assert any("share of play" in m for m in judged(said(play=0.69)).misses)
    assert not any("share of play" in m for m in judged(said(play=0.1), shared_out=["play"]).misses)
    loose = {"play": {"share": 0.8, "sigma": 0.2}, "gears": {"share": 0.15, "sigma": 0.01}}
    assert not any("share of play" in m for m in judged(said(play=0.1), families=loose).misses)


def test_what_the_arm_does_not_have_is_untrue_and_so_is_a_value_far_off():
    drift = finding("joint_drift", {"joint": 3, "driver": "time"}, name="rate")
    assert judged(said(finding(), drift)).untrue == [drift]
    wave = finding("gear_eccentricity", {"joint": 2, "order": 2}, value=0.0115, std=0.002, name="sin")
    assert judged(said(finding(), wave)).untrue == []
    once = finding("gear_eccentricity", {"joint": 2}, value=0.0115, std=0.002, name="sin")
    assert judged(said(finding(), once)).untrue == [once]
    large = finding("gear_eccentricity", {"joint": 2, "order": 2}, value=0.1, std=0.002, name="sin")
    assert judged(said(finding(), large)).untrue == [large]
    set_of_two = {
        **drift,
        "alternatives": [{"effect": "gear_eccentricity", "where": {"joint": 2, "order": 2}}],
    }
    assert judged(said(finding(), set_of_two)).untrue == []
    zero = finding("joint_zero", {"joint": 5}, name="offset")
    assert judged(said(finding(), zero)).untrue == []


def test_the_scorecard_counts_real_arms_apart_from_the_others():
    cases = [judge(answer(), said()), judge(answer(), said(second=0.2, again=0.3, play=0.2))]
    card = score(cases, "static")
    lines = {line.key: line.rate for line in card.lines}
    assert (lines["arm_transfer"].hits, lines["arm_transfer"].cases) == (1, 2)
    assert (lines["arm_self"].hits, lines["arm_self"].cases) == (1, 2)
    assert (lines["arm_shares"].hits, lines["arm_shares"].cases) == (3, 4)
    assert "one_name" not in lines and card.transfer["transfer"]["cases"] == 2


def test_an_unknown_effect_counts_where_a_name_stands_by_it():
    case = answer()
    case["truth"][0]["effect"] = "folded_gear"
    case["whole"]["members"][1] = {**PLAY, "effect": "folded_gear", "norm": 150.0}
    for verdict, hits in (("named", 1), ("partly", 0)):
        card = score([judge(case, said(verdict=verdict), frozenset({"folded_gear"}))], "static")
        assert {line.key: line.rate.hits for line in card.lines}["arm_unknown"] == hits


def test_shapes_of_one_joints_friction_share_its_curve_out():
    shapes = [
        ("coulomb_friction", "coulomb", 1.0),
        ("viscous_friction", "viscous", 0.5),
        ("quadratic_friction", "quadratic", 0.3),
    ]
    members = [
        {"effect": e, "where": {"joint": 2}, "parameters": {name: size}, "norm": 30.0}
        for e, name, size in shapes
    ]
    case = {**answer(members=members, families={}), "truth": [], "plan": {"fading": "tanh"}}

    def stated(effect, name, value, joint=2):
        told = finding(effect, {"joint": joint}, value=value, std=0.01, name=name)
        told["parameters"][0]["unit"] = ""
        return told

    two = [stated("coulomb_friction", "coulomb", 0.9), stated("viscous_friction", "viscous", 1.1)]
    whole = judge(case, said(*two)).whole
    assert whole.untrue == [] and whole.covered == []
    three = [*two, stated("quadratic_friction", "quadratic", 0.3)]
    assert [inside for _, _, inside in judge(case, said(*three)).whole.covered] == [False, False, True]
    elsewhere = stated("viscous_friction", "viscous", 0.5, joint=3)
    assert judge(case, said(*two, elsewhere)).whole.untrue == [elsewhere]


LOAD = {
    "effect": "payload",
    "where": {"body": "tool"},
    "parameters": {"mass": 2.0, "com_x": 0.0, "com_y": 0.0, "com_z": 0.1},
}


@pytest.mark.parametrize(("mass", "right"), [(2.05, True), (2.07, False), (None, False)])
def test_a_load_against_a_reference_is_right_within_three_percent(mass, right):
    case = answer(
        members=[LOAD], families={}, settled=False, oracle=None, reference="case_0000_reference.csv"
    )
    case["truth"] = [{**case["truth"][0], **LOAD}]
    stated = finding("payload", {"body": "tool"}, value=mass, std=0.05, name="mass")
    stated["parameters"][0]["unit"] = "kg"
    told = {"verdict": "named", "findings": [stated] if mass else [], "after": {}}
    whole = judge(case, told).whole
    assert whole.load is right and whole.consistent is None and not whole.shares
    friction = finding("coulomb_friction", {"joint": 2}, name="coulomb")
    assert judge(case, {**told, "findings": [friction]}).whole.untrue == [friction]


def perfect(case):
    """What a diagnosis that knew everything would say."""
    whole = case["whole"]
    shown = [m for m in whole["members"] if not whole.get("reference") or m in dominant_of(case)]
    findings = [
        {
            "effect": m["effect"],
            "where": m["where"],
            "parameters": [
                {"name": k, "value": v, "std": 0.01 * abs(v) + 1e-12, "unit": ""}
                for k, v in m["parameters"].items()
            ],
            "alternatives": [],
        }
        for m in shown
    ]
    return {
        "verdict": "named",
        "findings": findings,
        "after": {"fit_rms": 0.1},
        "families": [{"family": k, "share": v["share"]} for k, v in whole["families"].items()],
        "whole": {"self": {"fit_rms": 0.1}, "second": {"fit_rms": whole["oracle"] or 0.1}},
    }


def dominant_of(case):
    truths = [(t["effect"], t["where"]) for t in case["truth"]]
    return [m for m in case["whole"]["members"] if (m["effect"], m["where"]) in truths]


@pytest.mark.parametrize(
    ("package", "stratum"),
    [(package, key) for package in (STATIC, MOTION) for key in sorted(catalog.members(package, "STRATUM"))],
)
def test_who_knew_everything_would_miss_nothing(package, stratum, tmp_path):
    draw = draw_whole_static if package == STATIC else draw_whole_motion
    for index in range(3):
        case = draw(9, index, stratum, tmp_path)
        whole = judge(case, perfect(case)).whole  # laws of no library count as known to it
        assert whole.misses == [] and whole.transfer in (None, 1.0)
        assert whole.name in (None, True) and whole.value in (None, True)
        assert all(inside for _, _, inside in whole.covered)
