"""Markup in every text that a file or a person can bring: cards, panels, reports and pages show it as text.

Pieces one by one: tests/panel/test_markup.py; a diagnosis's every field: tests/diagnosis/report/test_markup.py.
"""

import json
from html.parser import HTMLParser
from types import SimpleNamespace

import numpy as np
import pytest

from app.calibration.report import two_robots_report
from app.cli import run
from app.errors import StorageError
from app.proof import page as scorecard
from app.proof.intervals import Rate
from app.session.actions import ChooseMode, Comment, Record
from app.session.points import load_action
from app.shell.unavailable import unavailable
from tests.desk import SECRET, brisk, desk, patient, plain, sit_at  # noqa: F401
from tests.kinematics.description.making import description, line

BAD = "<img src=x onerror=alert(1)><script>alert(2)</script>\"'><b>&amp;</b>"
AS_TEXT = "&lt;script&gt;"
#: What panels and reports are made of.
ALLOWED = {
    "html", "head", "meta", "title", "style", "body", "article", "section", "header", "footer", "div", "span", "p", "b",
    "br", "i", "h1", "h2", "h4", "dl", "dt", "dd", "table", "thead", "tbody", "tr", "th", "td", "ul", "li", "code",
    "figure", "figcaption", "details", "summary", "svg", "text", "rect", "line", "path", "g", "circle", "clippath",
    "polyline", "polygon", "small", "progress", "marker", "defs", "ellipse",
}  # fmt: skip


class Tags(HTMLParser):
    def __init__(self, page):
        super().__init__()
        self.tags, self.attributes = set(), set()
        self.feed(page)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}


def is_clean(page):
    found = Tags(page)
    assert found.tags <= ALLOWED, found.tags - ALLOWED
    assert not {name for name in found.attributes if name.startswith("on")}
    assert "<script" not in page and "<img" not in page


def points(folder, robot=""):
    rng = np.random.default_rng(0)
    q = np.array([0.2, -1.2, 1.1, -0.4, 0.6, 0.1]) + rng.uniform(-0.6, 0.6, (6, 6))
    rows = [f"touch,{','.join(f'{v:.5f}' for v in np.degrees(row))}" for row in q]
    path = folder / "<b>p.csv"
    head = [
        f"# title: {json.dumps(BAD)}",
        f"# note: {json.dumps(BAD)}",
        "# kind: points",
        f"# robot: {robot}",
    ]
    names = "role," + ",".join(f"q{j}_deg" for j in range(1, 7))
    path.write_text("\n".join([*head, names, *rows]) + "\n")
    return path


def test_the_scorecard_of_a_proof(monkeypatch):
    case = SimpleNamespace(whole=None)
    told = {"case": BAD, "stratum": BAD, "recording": BAD, "true": BAD, "verdict": BAD, "said": BAD}
    monkeypatch.setattr(scorecard, "failed", lambda _: True)
    monkeypatch.setattr(scorecard, "failure", lambda _: {**told, "leftover": {BAD: BAD}, "misses": [BAD]})
    rate = Rate(1, 2)
    line = SimpleNamespace(title=BAD, rate=rate, aim=0.5, met=True, also_at_most=None, at_most=False)
    score = SimpleNamespace(
        lines=[line],
        effects=[(BAD, rate, rate, rate)],
        coverage={BAD: rate},
        confusion={BAD: {BAD: 1, "(clean)": 2}},
        heldout=[(BAD, 1.0)],
        transfer={},
    )
    proof = SimpleNamespace(family=BAD, seed=BAD, command=BAD, seal=BAD, score=score, judged=[case])
    proof.controls, proof.versions = {BAD: (rate, [BAD, BAD])}, {BAD: BAD}
    page = scorecard.page(proof)
    is_clean(page)
    assert page.count(AS_TEXT) == 23


def test_the_page_of_two_robots():
    page = two_robots_report([BAD, BAD], [], None, made=BAD, language="zh")
    is_clean(page)
    assert page.count(AS_TEXT) == 6  # robots in the title and the head, date above and below


@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_points_file_on_the_sheet(language, tmp_path, capsys):
    (tmp_path / "arm.urdf").write_text(
        description(line(6))
        .replace("<robot name=", "<robot name='x' title=")
        .replace('"l6"', '"&lt;b&gt;l6"')
    )
    out = tmp_path / "sheet.html"
    code = run(["solve", str(points(tmp_path, "arm.urdf")), "--report", str(out), "--language", language])
    assert code == 0, capsys.readouterr().err
    sheet = out.read_text(encoding="utf-8")
    is_clean(sheet)
    assert AS_TEXT in sheet and "&lt;b&gt;p.csv" in sheet


@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_recording_and_its_robot_in_the_report(language, tmp_path, capsys):
    rng = np.random.default_rng(1)
    q = rng.uniform(-1.0, 1.0, (40, 2))
    arm = description(line(2)).replace('"j1"', '"&lt;script&gt;j1"').replace('"l2"', '"&lt;img src=x&gt;"')
    (tmp_path / "<i>arm.urdf").write_text(arm)
    rows = [f"{a:.6f},{b:.6f},{BAD.replace(',', '')}{k % 4}" for k, (a, b) in enumerate(q)]
    log = tmp_path / "<b>log.csv"
    head = [
        "# kind: touch",
        '# robot: "<i>arm.urdf"',
        f"# title: {json.dumps(BAD)}",
        f"# note: {json.dumps(BAD)}",
    ]
    # Quotes inside a cell are doubled, as CSV has them.
    cells = [row.rsplit(",", 1)[0] + ',"' + row.split(",", 2)[2].replace('"', '""') + '"' for row in rows]
    log.write_text("\n".join([*head, "q1_rad,q2_rad,target", *cells]) + "\n")
    out = tmp_path / "report.html"
    code = run(["diagnose", str(log), "--report", str(out), "--language", language])
    said = capsys.readouterr().err
    assert code == 0, said
    page = out.read_text(encoding="utf-8")
    is_clean(page)
    assert "&lt;b&gt;log.csv" in page


def html_of(desk):  # noqa: F811
    return [w.content for w in desk.context.ui.widgets() if w.content]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_what_a_person_types_and_loads_on_every_panel(desk, tmp_path, language):  # noqa: F811

    desk.live.choose("language", language)
    desk.idle()
    context = desk.context
    desk.does(lambda: context.do(ChooseMode("touch", 4)))
    desk.does(lambda: context.do(Record("touch1")))
    desk.does(lambda: context.do(Comment("touch1", BAD)))
    desk.does(lambda: context.say("warning", BAD))
    context.trainee = BAD
    for name in context.shelf.owners.titles(context.shelf.owner):
        context.shelf.owners.rename(name, BAD)
    desk.does(lambda: context.do(load_action(points(tmp_path, "ur10e"))))
    desk.does(context.rebuild)
    desk.does(context.refresh)
    shown = html_of(desk)
    for content in shown:
        is_clean(content)
    assert any(AS_TEXT in content for content in shown)


def test_why_there_is_no_page(monkeypatch):
    page = bytes(unavailable(StorageError(BAD)).body).decode()
    assert "<script" not in page and AS_TEXT in page
