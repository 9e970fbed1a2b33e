"""Markup in every text that a file, an engine or a person can bring stays text on the page, in both languages."""

import dataclasses
from html.parser import HTMLParser
from typing import Any

import pytest

from app.diagnosis.judging import BARE, WITH
from app.diagnosis.report import as_page
from app.diagnosis.result import Alternative, FamilyShare, Judged, Leftover, Noise, Parameter, Quality
from tests.diagnosis.report.cases import motion_case, static_case

HOSTILE = "<img src=x onerror=alert(1)><script>alert(2)</script>\"'><b>&amp;"
ALLOWED = {
    "html", "head", "meta", "title", "style", "body", "article", "section", "header", "footer", "div", "span", "p", "b",
    "br", "i", "h1", "h2", "dl", "dt", "dd", "table", "thead", "tbody", "tr", "th", "td", "ul", "li", "code", "figure",
    "figcaption", "details", "summary", "svg", "text", "rect", "line", "path", "g", "circle", "clippath",
}  # fmt: skip


class Tags(HTMLParser):
    """Names of all tags and attributes of a page."""

    def __init__(self, page: str):
        super().__init__()
        self.tags: set[str] = set()
        self.attributes: set[str] = set()
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}


def hostile(of: Any) -> Any:
    """Every text of a diagnosis replaced, keys of places and drivers too; joints are numbers."""
    finding = dataclasses.replace(
        of.findings[0],
        effect=HOSTILE,
        where={"joint": 1, "driver": HOSTILE, "body": HOSTILE, HOSTILE: HOSTILE},
        parameters=(Parameter(HOSTILE, 1.0, 0.1, HOSTILE),),
        alternatives=(Alternative(HOSTILE, {"link": HOSTILE, "axis": HOSTILE}, 1.0),),
        sentence=HOSTILE,
        equation=HOSTILE,
        heldout_unit=HOSTILE,
    )
    timed = dataclasses.replace(finding, where={"from_s": 1.0, "to_s": 2.0})
    evidence = dataclasses.replace(
        of.evidence,
        components=(HOSTILE,) * len(of.evidence.components),
        drivers={f"{HOSTILE} [{HOSTILE}]": v for v in of.evidence.drivers.values()},
        parts={HOSTILE: of.evidence.before},
    )
    steps = {BARE: Quality(1, 1, HOSTILE), WITH: Quality(1, 1, HOSTILE), HOSTILE: Quality(1, 1, HOSTILE)}
    return dataclasses.replace(
        of,
        file=HOSTILE,
        kind=HOSTILE,
        robot=HOSTILE,
        noise=Noise(0.1, HOSTILE, "stated"),
        findings=(finding, timed),
        families=(FamilyShare(HOSTILE, 0.5, 0.4, (0,)), FamilyShare("unnamed", 0.1, 0.3)),
        leftover=Leftover(0.01, {"link": HOSTILE, "driver": HOSTILE, HOSTILE: HOSTILE}, 0.1),
        notes=(HOSTILE,),
        judged=Judged(HOSTILE, steps),
        evidence=evidence,
    )


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("case", [static_case("partly"), motion_case()], ids=["static", "motion"])
def test_markup_in_every_text_stays_text(case, language):
    page = as_page([hostile(case)], [None], command=HOSTILE, date=HOSTILE, language=language)
    found = Tags(page)
    assert found.tags <= ALLOWED, found.tags - ALLOWED
    assert not {name for name in found.attributes if name.startswith("on")}
    assert page.count("&lt;img src=x") > 30  # it is there, as text


def test_what_looks_for_markup_finds_it():
    assert Tags(f"<p>{HOSTILE}</p>").tags == {"p", "img", "script", "b"}
