"""The sheet of two robots: figures with their units, 95% and the error of every point, in both languages."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from app.calibration.base.frame import in_parent
from app.calibration.report import two_robots_report
from app.estimation import HALF
from app.figures import NO_BREAK
from app.geometry import Pose
from app.simulation.tracker_cell import make_cell
from app.simulation.tracker_procedure import carry_out
from app.units import mm

ROBOTS = ("IRB 120", "UR10e")
HAN = re.compile(r"[\u4e00-\u9fff]")
#: What a sheet for a person holds nothing of: names of columns, of programs' fields, of matrices.
CODE = re.compile(r"\b\w+_\w+\b|\bdeg\b|\brms mm\b")


@pytest.fixture(scope="module")
def outcome():
    return carry_out(make_cell("irb120", "ur10e", 5), seed=5)


def sheet(outcome, language="en", **more):
    return two_robots_report(ROBOTS, outcome.bases, outcome.relation, language=language, **more)


def words(page):
    """What is read, without pictures' and style's own markup."""
    return re.sub(r"<[^>]+>", " ", re.sub(r"<style>.*?</style>", "", page, flags=re.DOTALL))


def test_position_stands_with_its_unit_and_its_95_percent_along_the_same_axes(outcome):
    relation, page = outcome.relation, sheet(outcome)
    half = HALF * np.sqrt(np.diag(in_parent(relation.T_base1_base2, relation.covariance)))
    for axis, value, width in zip("XYZ", mm(relation.T_base1_base2.position), mm(half[:3]), strict=True):
        assert f"<td>{axis} [mm]</td><td>{value:.3f}</td><td>{width:.3f}</td>" in page


def test_every_point_has_its_error_in_a_picture_that_is_well_formed(outcome):
    page = sheet(outcome)
    pictures = [ET.fromstring(svg) for svg in re.findall(r"<svg.*?</svg>", page)]
    bars = [len(list(picture.iter("rect"))) for picture in pictures if picture.findall("rect")][1:]
    assert bars == [len(a.arc) for base in outcome.bases for a in base.arcs]
    for picture in pictures:
        _, _, width, height = (float(v) for v in picture.get("viewBox").split())
        for dot in picture.iter("circle"):
            assert 0 <= float(dot.get("cx")) <= width and 0 <= float(dot.get("cy")) <= height


@pytest.mark.parametrize("language", ["en", "zh"])
def test_it_is_said_in_words_and_not_in_names_of_fields(outcome, language):
    said = words(sheet(outcome, language, made="2030-01-01 12:00"))
    assert not CODE.search(said.replace("________", "")), CODE.findall(said)
    assert "95%" in said and bool(HAN.search(said)) == (language == "zh")
    assert len(re.findall(r"[A-Za-z]{6,}", said)) < 3 or language == "en", said


def test_what_was_tried_is_told_and_what_was_not_is_not(outcome):
    assert "Tried" not in sheet(outcome)
    tried = sheet(outcome, missed=(4e-5, 6e-5)).replace(NO_BREAK, " ")
    assert "0.040 mm where 0.060 mm were predicted" in tried


def test_without_a_relation_the_sheet_says_so_and_keeps_what_was_measured(outcome):
    page = two_robots_report(ROBOTS, outcome.bases, None)
    assert "There is no relation" in page and 'class="light red"' in page
    assert page.count("<svg") == 4


def test_widths_are_turned_with_the_frame():
    quarter = Pose.exp(np.array([0.0, 0.0, 0.0, 0.0, 0.0, np.pi / 2]))
    turned = in_parent(quarter, np.diag([1.0, 4.0, 9.0, 16.0, 25.0, 36.0]))
    assert np.allclose(np.diag(turned), [4.0, 1.0, 9.0, 25.0, 16.0, 36.0])
