"""The scorer's rules on cases made by hand: strict where it should be, fair where nobody could tell."""

import pytest

from app.proof.intervals import Rate
from app.proof.matching import at_place, counted, in_set, names, names_truth
from app.proof.scoring import score
from app.proof.verdicts import judge, si_factor

TRUTH = {
    "effect": "joint_compliance",
    "where": {"joint": 2, "driver": "gravity_torque"},
    "parameters": {"compliance": 1e-5},
    "survives": 3.0,
    "nearest": 20.0,
    "lookalikes": [],
}


def finding(effect, where, alternatives=(), parameters=()):
    return {"effect": effect, "where": where, "alternatives": alternatives, "parameters": parameters}


def answer(*truths, stratum="single", **more):
    base = {"id": "case_0000", "stratum": stratum, "kind": "tracker", "topology": "x", "noise_mm": 0.1}
    return {**base, "truth": list(truths), **more}


def said(*findings, verdict="named", **more):
    return {"verdict": verdict, "findings": list(findings), "leftover": {"where": {}}, **more}


@pytest.mark.parametrize(
    ("effect", "where", "right"),
    [
        ("joint_compliance", {"joint": 2}, True),
        ("joint_compliance", {"joint": 3}, False),
        ("joint_compliance", {}, False),
        ("joint_zero", {"joint": 2}, False),
    ],
)
def test_a_name_is_right_only_with_its_joint(effect, where, right):
    assert names(finding(effect, where), TRUTH["effect"], TRUTH["where"]) is right


def test_an_axis_left_out_is_not_held_against_a_finding_but_a_wrong_one_is():
    true = {"link": 2, "axis": "a"}
    assert names(finding("link_length", {"link": 2}), "link_length", true)
    assert not names(finding("link_length", {"link": 2, "axis": "d"}), "link_length", true)


def test_backlash_by_approach_is_not_backlash_by_weight():
    true = {"joint": 3, "driver": "approach"}
    assert names(finding("backlash", {"joint": 3, "driver": "approach"}), "backlash", true)
    assert not names(finding("backlash", {"joint": 3, "driver": "gravity_torque"}), "backlash", true)


@pytest.mark.parametrize(("row", "right"), [(30, True), (32, True), (33, False), (27, False)])
def test_a_step_may_be_two_rows_off_and_no_more(row, right):
    said_so = finding("tool_slip", {"body": "tool", "from_row": row})
    assert names(said_so, "tool_slip", {"body": "tool", "from_row": 30}) is right


def test_a_coupling_from_another_source_is_another_coupling():
    true = {"joint": 4, "source_joint": 5}
    assert not names(finding("joint_coupling", {"joint": 4, "source_joint": 3}), "joint_coupling", true)


def test_the_place_is_right_without_the_name_and_a_joint_is_not_a_link():
    assert at_place({"joint": 2}, TRUTH)
    assert not at_place({"link": 2}, TRUTH)
    assert not at_place({"driver": "time"}, TRUTH)


def test_an_alias_that_nobody_can_tell_counts_and_a_near_one_does_not():
    alias = {"effect": "gear_ratio", "where": {"joint": 2}, "gap": 1.0}
    other = finding("gear_ratio", {"joint": 2})
    assert names_truth(other, {**TRUTH, "lookalikes": [alias]})
    assert not names_truth(other, TRUTH)


def test_the_reported_set_holds_the_alternatives():
    also = [{"effect": "joint_compliance", "where": {"joint": 2}, "delta_bic": 3.0}]
    assert in_set([finding("gear_ratio", {"joint": 2}, also)], TRUTH)
    assert not in_set([finding("gear_ratio", {"joint": 2})], TRUTH)


def test_geometry_is_true_where_all_geometry_is_off_and_false_elsewhere():
    length = finding("link_length", {"link": 3})
    assert counted([length], answer(TRUTH, clutter_mm=0.2)) == []
    assert counted([length], answer(TRUTH)) == [length]


def test_whatever_is_named_on_a_clean_recording_is_false():
    case = judge(answer(stratum="clean"), said(finding("joint_zero", {"joint": 2})))
    assert case.empty and len(case.false) == 1 and not case.right
    assert judge(answer(stratum="clean"), said(verdict="clean")).right


def test_an_effect_outside_the_library_has_no_right_name():
    strange = {**TRUTH, "effect": "folded_gear"}
    case = judge(
        answer(strange, stratum="outside"),
        said(finding("gear_ratio", {"joint": 2})),
        frozenset({"folded_gear"}),
    )
    assert len(case.false) == 1 and not case.seen


def test_the_place_of_what_stays_unexplained_is_a_place_said():
    left = said(verdict="unexplained", leftover={"where": {"joint": 2}})
    case = judge(answer(TRUTH), left)
    assert case.place == [True] and case.name == [False] and case.listed == [False]


def test_a_second_finding_beside_the_truth_is_false_and_the_case_not_right():
    case = judge(
        answer(TRUTH), said(finding("joint_compliance", {"joint": 2}), finding("joint_zero", {"joint": 4}))
    )
    assert case.name == [True] and len(case.false) == 1 and not case.right


def test_an_effect_that_the_calibration_swallowed_is_not_asked_for():
    faint = {**TRUTH, "survives": 1.4}
    assert judge(answer(faint), said(verdict="clean")).seen == []


def test_a_refusal_is_a_failure():
    case = judge(answer(TRUTH), {"error": "fault"})
    assert case.verdict == "error" and not case.right


@pytest.mark.parametrize(("value", "inside"), [(11.0, True), (11.9, True), (12.1, False)])
def test_coverage_asks_whether_the_95_percent_interval_holds_the_truth_in_its_own_unit(value, inside):
    truth = {**TRUTH, "effect": "joint_zero", "where": {"joint": 2}, "parameters": {"offset": 0.010}}
    stated = [{"name": "offset", "value": value, "std": 1.0, "unit": "mm"}]
    case = judge(answer(truth), said(finding("joint_zero", {"joint": 2}, parameters=stated)))
    assert case.covered == [("joint_zero", "offset", inside)]


def test_units_with_a_denominator_come_to_si():
    assert si_factor("mm/s") == pytest.approx(1e-3)
    assert si_factor("deg/s") == pytest.approx(0.017453292519943)
    assert si_factor("rad/Nm") == si_factor("1/s") == si_factor("kg") == 1.0


def test_wilsons_interval_is_the_published_one():
    """Newcombe (1998), table I: 81 of 263 and 0 of 20, score method without correction."""
    assert Rate(81, 263).interval == pytest.approx((0.2553, 0.3662), abs=5e-5)
    assert Rate(0, 20).interval == pytest.approx((0.0, 0.1611), abs=5e-5)
    assert Rate(0, 0).interval == (0.0, 1.0)


def test_the_scorecard_counts_each_stratum_by_its_own_rule():
    right = finding("joint_compliance", {"joint": 2})
    wrong = finding("gear_ratio", {"joint": 2})
    cases = [
        judge(answer(stratum="clean"), said(verdict="clean")),
        judge(answer(stratum="clean"), said(wrong)),
        judge(answer(TRUTH), said(right, after={"heldout_rms": 0.103, "unit": "mm"})),
        judge(answer(TRUTH), said(wrong)),
    ]
    card = score(cases, "static")
    lines = {line.key: line for line in card.lines}
    assert (lines["clean"].rate, lines["clean"].met) == (Rate(1, 2), False)
    assert lines["single_place"].rate == Rate(2, 2) and lines["single_name"].rate == Rate(1, 2)
    assert card.confusion["joint_compliance"] == {"joint_compliance": 1, "gear_ratio": 1}
    assert card.confusion["(nothing)"] == {"(clean)": 1, "gear_ratio": 1}
    assert card.heldout == [("single", pytest.approx(1.03))]
