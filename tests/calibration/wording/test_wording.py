"""What calibration says is there in every language, says the same, and reaches the reader in their own."""

import ast
import re
from pathlib import Path

import numpy as np
import pytest

import app.calibration
from app.calibration.checks import refusal
from app.calibration.modes import mode
from app.calibration.quality.light import light
from app.calibration.solving import solve_file
from app.calibration.tool import calibrate
from app.calibration.wording import FALLBACK, TEXTS, name_of, phrase, remark
from app.errors import DegenerateGeometryError
from app.geometry import rot_z
from app.resources import STATIC
from tests.calibration.drawing import captures, touches
from tests.source import parsed
from tests.translations import unlike

OTHERS = [language for language in TEXTS.languages if language != FALLBACK]
CODE = Path(app.calibration.__file__).parent
CHINESE = re.compile(r"[\u4e00-\u9fff]")


def calls(*names):
    """(file, call) of every call of these functions in calibration."""
    for path in sorted(CODE.rglob("*.py")):
        if path.is_relative_to(CODE / "base"):  # has a family of its own
            continue
        for node in ast.walk(parsed(path)):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in names:
                yield path.name, node


def constants(call):
    return [a.value for a in call.args if isinstance(a, ast.Constant) and isinstance(a.value, str)]


def test_chinese_is_among_the_languages():
    assert "zh" in OTHERS


@pytest.mark.parametrize("language", OTHERS)
def test_every_language_has_every_sentence_with_the_same_fields(language):
    english, other = TEXTS.languages[FALLBACK], TEXTS.languages[language]
    assert sorted(english) == sorted(other)
    assert not unlike(english, other)


def test_every_sentence_the_code_asks_for_is_there():
    asked = set()
    for file, call in calls("phrase"):
        asked |= {(file, key) for key in constants(call)}
    for prefix, name in (("check", "remark"), ("refused", "degenerate")):
        for file, call in calls(name):
            if keys := constants(call):
                key = next((k for k in keys[::-1] if k), keys[0])
                asked |= {(file, f"{prefix}.{key}"), (file, f"{prefix}.{key}_do")}
    missing = [(file, key) for file, key in sorted(asked) if not TEXTS.has(key)]
    assert len(asked) > 50 and not missing


@pytest.mark.parametrize(
    "prefix, files",
    [
        ("page", ["text.py"]),
        (
            "sheet",
            ["report/page.py", "report/pictures.py", "report/cell_picture.py", "report/templates/sheet.html"],
        ),
    ],
)
def test_every_sentence_the_pages_ask_for_is_there_and_none_is_left_over(prefix, files):
    asked = set()
    for file in files:
        text = (CODE / file).read_text(encoding="utf-8")
        if file.endswith(".html"):
            asked |= set(re.findall(r"\bt\(\"(\w+)\"", text))
            continue
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                asked.add(node.value.removeprefix(f"{prefix}."))
    there = {key.partition(".")[2] for key in TEXTS.languages[FALLBACK] if key.startswith(f"{prefix}.")}
    left_over = {key for key in there - asked if not key.startswith("column_")}
    called = {
        key
        for file in files
        for key in re.findall(r"(?:\bt|_t|words)\(\s*\"(\w+)\"", (CODE / file).read_text(encoding="utf-8"))
    }
    assert not left_over and not called - there


@pytest.mark.parametrize("language", TEXTS.languages)
def test_every_code_a_check_or_a_refusal_gives_has_a_name(language):
    made = [call.args[0] for _, call in calls("remark", "degenerate")]
    codes = {first.value for first in made if isinstance(first, ast.Constant)}
    codes |= {path.stem for path in (CODE / "checks").glob("[a-z]*.py")}
    assert not [code for code in codes if not TEXTS.has(f"name.{code}", language)]
    assert name_of("not_known_at_all", language) == "not known at all"


def test_what_a_check_says_in_english_is_what_json_gets():
    warning = remark("short_stroke", axis="Z", length=20.0, noise=0.3, deg=1.2, asked=100.0)
    assert warning.said("en") == str(warning) and "along Z is 20.0 mm" in str(warning)
    assert CHINESE.search(warning.said("zh")) and "20.0 mm" in warning.said("zh")


def test_a_list_of_phrases_is_joined_as_the_language_does():
    pairs = tuple(phrase("check.too_alike_pair", first=1, second=k, deg=2.0) for k in (2, 3))
    said = phrase("check.too_alike", pairs=pairs)
    assert "1 and 2 (2.0 degrees), 1 and 3" in str(said)
    assert "、第 1 次与第 3 次" in said.text("zh")


@pytest.mark.parametrize("points", [touches(2), touches(rotations=rot_z(np.arange(4.0) / 3))])
def test_a_refusal_speaks_chinese_too(points):
    with pytest.raises(DegenerateGeometryError) as caught:
        calibrate(captures(*points))
    warning = refusal(caught.value)
    assert CHINESE.search(warning.said("zh")) and warning.said("en") == str(caught.value)


def test_the_light_speaks_chinese_whatever_its_reason():
    demo = mode("touch_zx").demo(touches=4, noise=1e-4)
    for result in (
        mode("touch_zx").solve(demo.captures),
        mode("direct").solve(()),
        calibrate(captures(*touches(4, 0.05, 1e-4))),
        calibrate(captures(*touches(4, 0.6, 3e-3))),
    ):
        found = light(result)
        assert CHINESE.search(found.why.text("zh")) and CHINESE.search(found.todo.text("zh"))
        assert str(found) == f"{found.colour.upper()}: {found.reason}. {found.action}."


def test_a_gap_speaks_chinese():
    solved = solve_file(STATIC / "samples" / "xiong2012_table1.csv")
    assert solved.gaps and all(CHINESE.search(gap.sentence("zh")) for gap in solved.gaps)
