"""The page: self-contained, well-formed, the same every time, and safe whatever a file is called."""

import dataclasses
import re
import xml.etree.ElementTree as ET
from html.parser import HTMLParser

import numpy as np
import pytest

from app.diagnosis.report import as_page, write_report
from app.errors import InputError
from tests.diagnosis.report.cases import motion_case, static_case

VERDICTS = ["clean", "named", "partly", "unexplained"]


def page(*diagnoses, **more):
    return as_page(
        diagnoses,
        [None] * len(diagnoses),
        command="teachframe diagnose x.csv",
        date="2030-01-01 12:00",
        **more,
    )


class Outline(HTMLParser):
    """Every tag that opens is closed, and what the page would fetch."""

    def __init__(self, text):
        super().__init__()
        self.open, self.fetched, self.heads = [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        if tag not in ("meta", "br"):
            self.open.append(tag)
        self.fetched += [
            v for k, v in attrs if k in ("src", "href", "srcset", "data", "action", "xlink:href")
        ]
        assert tag not in ("script", "link", "iframe", "img", "object"), tag

    def handle_startendtag(self, tag, attrs):
        pass

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "h2":
            self.heads.append(data)


@pytest.mark.parametrize("case", [*map(static_case, VERDICTS), motion_case()], ids=[*VERDICTS, "motion"])
def test_the_page_fetches_nothing_and_closes_every_tag(case):
    text = page(case)
    outline = Outline(text)
    assert outline.open == [] and outline.fetched == []
    addresses = set(re.findall(r"https?://[^\s\"'<]+", text))
    assert addresses <= {"http://www.w3.org/2000/svg"}  # the name of SVG, never fetched
    assert "@import" not in text
    assert not re.search(r"url\((?!#)", text)


@pytest.mark.parametrize("case", [static_case(), motion_case()], ids=["static", "motion"])
def test_every_picture_is_valid_svg_with_finite_numbers(case):
    pictures = re.findall(r"<svg.*?</svg>", page(case), flags=re.S)
    assert len(pictures) >= 6
    for picture in pictures:
        root = ET.fromstring(picture)
        assert root.get("aria-label")
        assert not re.search(r"\b(nan|inf)\b", picture, flags=re.I)


def test_a_named_static_case_has_every_section():
    assert Outline(page(static_case())).heads == [
        "Where the millimetres come from",
        "What was left out",
        "What the error follows",
        "Where in the work space",
        "Rows set aside",
        "Record these next",
        "Notes",
        "How to read this page",
    ]


def test_a_motion_case_shows_torques_and_its_contact_window():
    text = page(motion_case())
    assert "Torque over time" in Outline(text).heads
    assert 'class="window"' in text and "time a finding points at" in text


def test_without_evidence_the_words_still_stand():
    bare = dataclasses.replace(static_case(), evidence=None)
    assert "Joint compliance" in page(bare) and "Where in the work space" not in page(bare)


def test_nothing_is_named_on_a_page_without_a_finding():
    assert "compliance" not in page(static_case("unexplained")).lower()


def test_the_same_diagnosis_gives_the_same_page():
    assert page(static_case()) == page(static_case())


def test_names_from_outside_are_text_and_never_markup():
    hostile = "<img src=x onerror=alert(1)>&\"'.csv"
    case = dataclasses.replace(static_case(), file=hostile, robot=hostile, notes=(hostile,))
    Outline(page(case))


def test_missing_values_leave_gaps_and_no_fault():
    case = static_case()
    gaps = {
        name: np.where((np.arange(60) % 3 == 0)[:, None], np.nan, getattr(case.evidence, name))
        for name in ("before", "after", "points_measured")
    }
    text = page(dataclasses.replace(case, evidence=dataclasses.replace(case.evidence, **gaps)))
    assert "nan" not in re.sub(r"<style>.*?</style>", "", text, flags=re.S).lower()


def test_a_long_log_stays_a_small_page():
    assert len(page(motion_case(seconds=600.0, rate=250))) < 1_500_000


def test_several_recordings_share_a_page():
    text = page(static_case(), motion_case())
    assert "cell_7.csv" in text and "log_a.csv" in text and text.count("<article") == 2


def test_a_page_that_cannot_be_written_names_its_file(tmp_path):
    with pytest.raises(InputError, match=r"no such folder"):
        write_report(tmp_path / "none" / "out.html", [static_case()], [None], command="x")
    assert not list(tmp_path.iterdir())
