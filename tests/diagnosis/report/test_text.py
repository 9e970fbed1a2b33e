"""The terminal's text: golden, and what must hold whatever the numbers are."""

import dataclasses
import math
import re

import pytest

from app.diagnosis.report import as_page, as_text
from app.diagnosis.report.wording import digits, probability
from app.diagnosis.result import Noise, Quality
from app.figures import NO_BREAK
from tests.diagnosis.report.cases import motion_case, static_case
from tests.golden_text import assert_golden


@pytest.mark.parametrize("verdict", ["clean", "named", "partly", "unexplained"])
def test_the_text_of_every_verdict_is_golden(verdict):
    assert_golden(f"diagnose_{verdict}.txt", as_text(static_case(verdict), seconds=False))


def test_the_text_of_a_motion_recording_is_golden():
    assert_golden("diagnose_motion.txt", as_text(motion_case(), seconds=False))


@pytest.mark.parametrize("verdict", ["clean", "unexplained"])
def test_no_effect_is_named_in_the_text_where_none_was_found(verdict):
    assert "compliance" not in as_text(static_case(verdict)).lower()


def test_a_line_is_never_wider_than_the_page():
    long = dataclasses.replace(static_case("partly"), notes=("word " * 80,))
    assert max(len(line) for line in as_text(long).splitlines()) <= 100


def test_numbers_that_are_unknown_do_not_break_the_text():
    nothing = dataclasses.replace(
        static_case("clean"),
        noise=Noise(math.nan, "mm", "residual"),
        before=Quality(math.nan, math.nan, "mm"),
        after=Quality(0.1, math.nan, "mm"),
    )
    assert "nan" not in as_text(nothing).lower()


def test_a_sliding_joint_is_proposed_in_millimetres():
    text = as_text(static_case(), prismatic=(False, False, True, False, False, False))
    assert "1200.0 mm" in text and "5.7°" in text


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_uncertainty_of_text_and_page_is_95_percent(language):
    case = static_case()
    (finding,) = case.findings
    (compliance,) = finding.parameters
    half = f"± {1.96 * compliance.std * 1e6:.2f} µrad/Nm (95%)"
    page = as_page([case], [None], command="", language=language)
    for said in (as_text(case), page):
        assert half in said.replace(NO_BREAK, " ")
        assert all("95%" in rest[:40] for rest in said.split("±")[1:]), said
    assert not re.search(r"standard deviation|one.sigma|一个标准差|一倍标准差", page)


def test_three_digits_are_kept_without_an_exponent():
    assert [digits(v) for v in (0.01234, 1.234, 1234.5, 0.0)] == ["0.0123", "1.23", "1234", "0"]


def test_a_vanishing_probability_is_a_bound_not_a_zero():
    assert probability(0.0) == "p < 0.0001"
