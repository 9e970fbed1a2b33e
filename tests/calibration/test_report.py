"""The sheet: complete, self-contained, safe."""

import re
import xml.etree.ElementTree as ET

import pytest

from app.calibration.report import report
from app.calibration.solving import solve_file
from app.cli import run
from app.figures import NO_BREAK
from app.resources import STATIC

TABLE_1 = STATIC / "samples" / "xiong2012_table1.csv"


@pytest.fixture(scope="module")
def sheet():
    return report(solve_file(TABLE_1, method="pairwise"), made="2012-06-01", operator="X. Shuo")


def test_the_sheet_holds_picture_points_residuals_uncertainty_conditions_and_signatures(sheet):
    for part in (
        "<h1>",
        "119.621",
        "95%",
        "Touches",
        "4 (worst)",
        "Conditions",
        "Checked by",
        "X. Shuo",
        "Light: YELLOW.",
    ):
        assert part in sheet, part
    assert sheet.count("<svg") == 4


@pytest.mark.parametrize(("language", "light"), [("en", "Light: YELLOW."), ("zh", "指示灯：黄。")])
def test_on_paper_the_light_is_a_word_and_not_a_colour_alone(language, light):
    """A printer without colours leaves a grey bar."""
    solved = solve_file(TABLE_1, method="pairwise")
    sheet = report(solved, language=language, of="接触" if language == "zh" else "touches")
    assert re.search(rf'<div class="light yellow"><b>{light}</b> \S', sheet)
    assert TABLE_1.name not in sheet  # what no file holds is called by what was taught


def test_a_rotation_vector_is_in_radians_as_universal_robots_shows_it(sheet):
    row = re.search(r"rotvec \(Universal Robots\)(.*?)</tr>", sheet, re.DOTALL)
    assert row is not None and f"{NO_BREAK}rad" in row.group(1) and "°" not in row.group(1)
    assert max(abs(float(v)) for v in re.findall(r"-?\d+\.\d+", row.group(1))) <= 3.1416


def test_the_sheet_needs_nothing_from_outside(sheet):
    assert "<script" not in sheet and "http" not in sheet and "src=" not in sheet


def test_the_pictures_are_well_formed_and_their_parts_lie_inside(sheet):
    for svg in re.findall(r"<svg.*?</svg>", sheet):
        root = ET.fromstring(svg)
        _, _, width, height = (float(v) for v in root.get("viewBox").split())
        for circle in root.iter("circle"):
            assert 0 <= float(circle.get("cx")) <= width and 0 <= float(circle.get("cy")) <= height
        for bar in root.iter("rect"):
            assert float(bar.get("height")) >= 0


def test_what_a_file_says_of_itself_is_text_on_the_sheet_and_nothing_else(tmp_path):
    path = tmp_path / "p.csv"
    text = TABLE_1.read_text(encoding="utf-8")
    path.write_text(re.sub("# title: .*", "# title: '<script>alert(1)</script>'", text), encoding="utf-8")
    made = report(solve_file(path))
    assert "<script" not in made and "&lt;script&gt;" in made


def test_the_command_line_writes_the_sheet_of_one_file(tmp_path, capsys):
    out = tmp_path / "sheet.html"
    assert run(["solve", str(TABLE_1), "--report", str(out)]) == 0
    assert out.read_text(encoding="utf-8").startswith("<!doctype html>")
    assert run(["solve", str(TABLE_1), str(TABLE_1), "--report", str(out)]) == 2
    assert "one FILE" in capsys.readouterr().err


def test_page_and_sheet_speak_chinese_when_asked_and_json_stays_english(tmp_path, capsys):
    out = tmp_path / "sheet.html"
    assert run(["solve", str(TABLE_1), "--language", "zh", "--report", str(out)]) == 0
    page, sheet = capsys.readouterr().out, out.read_text(encoding="utf-8")
    assert "法兰中的工具点" in page and "条件数" in page and "distance" not in page
    assert '<html lang="zh">' in sheet and "审核" in sheet and "Checked by" not in sheet
    assert run(["solve", str(TABLE_1), "--language", "zh", "--json"]) == 0
    in_chinese = capsys.readouterr().out
    assert run(["solve", str(TABLE_1), "--json"]) == 0
    assert capsys.readouterr().out == in_chinese
