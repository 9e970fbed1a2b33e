"""The error budget: amounts that add up, one sentence, the same numbers wherever they are read."""

import dataclasses
import re
from html import escape

import numpy as np
import pytest

from app.diagnosis.report import as_page, as_text
from app.diagnosis.report.budget import (
    Budget,
    Step,
    budget,
    budget_sentence,
    law_share,
    percent,
    shared_note,
    shown,
    unexplained_sentence,
)
from app.diagnosis.report.drawing.budget_bar import budget_bar
from app.diagnosis.report.drawing.joint_bars import joint_bars
from app.diagnosis.report.wording import measure
from app.diagnosis.result import FamilyShare, Leftover, Quality
from app.diagnosis.wording import WORDS
from app.figures import NO_BREAK
from tests.diagnosis.report.cases import compliance, motion_case, static_case


def arm_off_everywhere():
    """5.1 mm, most of it zeros; one law of elasticity is worth a name, one is not."""
    small = dataclasses.replace(
        compliance(), where={"joint": 5}, heldout_rms_without=0.31, heldout_rms_with=0.06
    )
    large = dataclasses.replace(compliance(), heldout_rms_without=1.9, heldout_rms_with=0.06)
    return dataclasses.replace(
        static_case("partly"),
        before=Quality(5.0, 5.1, "mm"),
        after=Quality(0.05, 0.06, "mm"),
        findings=(large, small),
        families=(
            FamilyShare("zeros", 0.97, 0.3),
            FamilyShare("geometry", 0.02, 0.2),
            FamilyShare("elasticity", 0.01, 0.12, (0, 1)),
            FamilyShare("unnamed", 0.005, 0.06),
        ),
        leftover=Leftover(0.002, {"joint": 3, "driver": "own_angle"}, 0.004),
    )


def test_amounts_and_what_is_left_add_up_to_the_error_before():
    for case in (arm_off_everywhere(), static_case(), motion_case()):
        of = budget(case)
        assert sum(s.amount for s in of.steps) + of.rest == pytest.approx(case.before.heldout_rms, abs=1e-12)


def test_the_sentence_says_where_the_millimetres_come_from():
    assert budget_sentence(arm_off_everywhere()) == (
        "Of 5.10 mm, 4.8 are joint zeros, 0.10 geometry, 0.080 elasticity; 0.060 has no name; "
        "0.060 is left (noise 0.15)."
    )
    assert (
        budget_sentence(motion_case())
        == "Of 2.95 Nm, 1.9 are friction, 0.45 events; 0.57 is left and taken for noise."
    )
    assert budget_sentence(static_case()).endswith("; 0.15 is noise.")  # stated in the file
    assert (
        budget_sentence(motion_case(), "zh")
        == "2.95 Nm 中，1.9 来自摩擦，0.45 来自突变；0.57 剩余，视为噪声。"
    )


def test_what_no_name_explains_is_said_beside_the_names_and_takes_none_away():
    case = arm_off_everywhere()
    said = unexplained_sentence(case)
    assert said == "No name explains <1% of the error's mean square (p = 0.002)."
    text = as_text(case)
    assert said in text and "Joint compliance · joint 2" in text
    assert unexplained_sentence(static_case("named")) == ""
    unmeasured = dataclasses.replace(case, leftover=Leftover(1.0, {}, 0.0))
    assert unexplained_sentence(unmeasured) == ""


def test_a_family_that_makes_it_worse_takes_nothing_and_the_sum_still_holds():
    case = dataclasses.replace(
        static_case(), families=(FamilyShare("zeros", 0.0, 0.9), FamilyShare("elasticity", 0.9, 0.153))
    )
    of = budget(case)
    assert [s.amount for s in of.steps] == pytest.approx([0.0, 0.842 - 0.153])
    assert "joint zeros" not in budget_sentence(case)


def test_a_family_that_adds_nothing_but_would_be_missed_has_a_dash_and_a_note_says_why():
    """ "0 mm, 2% comes back" reads as a contradiction: what it explains was counted with those before it."""
    off = arm_off_everywhere()
    zeros, geometry, *others = off.families
    case = dataclasses.replace(
        off, families=(zeros, dataclasses.replace(geometry, heldout_rms_after=0.3), *others)
    )
    note = WORDS.text("budget.shared", "en")
    text, page = as_text(case), as_page([case], [None], command="x", date="")
    assert re.search(r"geometry +– +0.300 mm +2%", text) and "geometry            0" not in text
    assert note in text.replace("\n  ", " ") and escape(note, quote=False) in page
    assert '<span class="amount">–</span><span class="soft">2% comes back' in page
    assert case.to_json()["families"][1]["heldout_rms_after"] == 0.3
    for without in (
        off,
        dataclasses.replace(off, families=(zeros, FamilyShare("geometry", 0.0, 0.3), *others[:1])),
    ):
        assert (
            note not in as_text(without) and shared_note(shown(budget(without)), budget(without), "zh") == ""
        )


def test_laws_below_a_fiftieth_of_the_error_are_folded():
    case = arm_off_everywhere()
    step = budget(case).steps[2]
    assert (step.members, step.small) == ((0,), (1,))
    assert law_share(case.findings[1], case) == pytest.approx((0.31**2 - 0.06**2) / 5.1**2)
    text = as_text(case)
    assert "1 more below 2% of the error each: Joint compliance (joint 5)" in text
    assert "2. Joint compliance" not in text


def test_a_diagnosis_without_families_has_no_budget():
    bare = dataclasses.replace(static_case(), families=())
    assert budget_sentence(bare) == "" and budget_bar(budget(bare)) == ""
    assert "error budget" not in as_text(bare) and "Joint compliance" in as_text(bare)


def test_text_page_and_json_show_the_same_numbers():
    case = arm_off_everywhere()
    families = case.to_json()["families"]
    text, page = as_text(case), as_page([case], [None], command="x", date="").replace(NO_BREAK, " ")
    left = case.to_json()["before"]["heldout_rms"]
    for family in families:
        amount = measure(left - family["heldout_rms_after"], "mm")
        left = family["heldout_rms_after"]
        assert f"{amount:>12}{measure(left, 'mm'):>12}   {percent(family['share']):>4}" in text
        assert (
            f'<span class="amount">{amount}</span><span class="soft">{escape(percent(family["share"]))} comes'
            in page
        )
    assert budget_sentence(case) in text.replace("\n", " ") and escape(budget_sentence(case)) in page


def test_the_bar_is_as_wide_as_the_error_and_its_parts_as_their_amounts():
    case = arm_off_everywhere()
    drawn = budget_bar(budget(case), width=680.0)
    widths = [float(w) for w in re.findall(r'width="([\d.]+)" height="30"', drawn)]
    assert len(widths) == 5
    assert sum(widths) + len(widths) == pytest.approx(680.0, abs=1.0)  # one unit of air a part
    assert widths[0] + 1 == pytest.approx(680.0 * 4.8 / 5.1, abs=0.1)


def test_each_joints_bar_is_divided_by_what_explains_its_torque():
    case = motion_case()
    drawn = joint_bars(case.evidence)
    bars = re.findall(r'y="([\d.]+)" width="([\d.]+)" height="15" fill="([^"]+)"', drawn)
    third = [(float(w), fill) for y, w, fill in bars if float(y) == 4 + 2 * 21]
    wide = {fill: w for w, fill in third}
    rubs = np.sqrt(np.mean(case.evidence.before[:, 2] ** 2))
    assert max(wide, key=lambda fill: wide[fill]) == "#c2407a"  # friction
    assert sum(wide.values()) == pytest.approx(680 - 120, abs=2.0)  # the longest bar: joint 3
    assert f"{rubs:.1f} Nm" in drawn
    assert joint_bars(dataclasses.replace(case.evidence, parts={})) == ""


def test_a_family_that_is_one_law_is_named_though_others_could_take_over_most_of_it():
    off = arm_off_everywhere()
    only = dataclasses.replace(off.findings[0], heldout_rms_without=0.07)  # masses or zeros would do as well
    told = dataclasses.replace(off, findings=(only,), families=(FamilyShare("elasticity", 0.24, 0.06, (0,)),))
    (step,) = budget(told).steps
    assert (step.members, step.small) == ((0,), ())
    faint = dataclasses.replace(told, families=(FamilyShare("elasticity", 0.01, 0.06, (0,)),))
    assert budget(faint).steps[0].small == (0,)


def test_a_finding_whose_share_was_measured_has_it_whatever_others_take_over_of_it():
    """Friction of six joints: taken out one by one, the others bend to it; it is 19% of the error all the same."""
    taken_over = dataclasses.replace(compliance(), heldout_rms_without=0.0601, heldout_rms_with=0.06)
    assert law_share(taken_over, arm_off_everywhere()) < 0.01
    assert law_share(dataclasses.replace(taken_over, share=0.19), arm_off_everywhere()) == 0.19


def test_families_that_nobody_sees_in_the_bar_are_one_entry_of_its_legend():
    amounts = {"zeros": 3.0, "geometry": 0.5, "play": 0.02, "events": 0.03, "couplings": 0.0}
    steps = tuple(Step(family, amount, 0.0, 0.1) for family, amount in amounts.items())
    whole = Budget(sum(amounts.values()) + 1.0, "mm", steps, 1.0)
    drawn = budget_bar(whole)
    labels = re.findall(r">([^<>]+)</text>", drawn)
    assert "2 others 0.050" in labels and "joint zeros 3.0" in labels
    alone = budget_bar(Budget(whole.total, "mm", steps[:3], 1.0))
    assert "others" not in alone and ">play 0.020<" in alone  # one of them keeps its name
