"""Base frames speak every language: no text missing, none left over, no English word in a Chinese run."""

import ast
from pathlib import Path

import numpy as np
import pytest

import app.calibration.base
from app.calibration.base.run import ArcResult, run_base
from app.calibration.base.wizard import BaseWizard, steps
from app.calibration.base.wording import TEXTS, remark
from app.calibration.result import Warning_
from app.errors import ActionRefusedError, DegenerateGeometryError
from app.phrases import FALLBACK, Phrase
from tests.calibration.base.files import cell, write
from tests.chinese import CHINESE, english_left
from tests.translations import FIELD, unlike

CODE = Path(app.calibration.base.__file__).parent
OTHERS = [language for language in TEXTS.languages if language != FALLBACK]
#: A value for every field that holds text; the others hold numbers.
WORDS = {
    "name": "N1",
    "robot": "ur10e",
    "file": "a.csv",
    "rows": (3, 4),
    "axes": 1,
    "step": "1",
    "error": "",
    "seen": "",
    "todo": "",
}


def _constants(node):
    return [n.value for n in ast.walk(node) if isinstance(n, ast.Constant) and isinstance(n.value, str)]


def _calls():
    """(function, its string constants) of every call in base frames that asks for a text."""
    for path in sorted(CODE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call):
                name = getattr(node.func, "id", getattr(node.func, "attr", ""))
                yield name, [text for argument in node.args for text in _constants(argument) if text]


def test_every_finding_and_refusal_of_the_code_has_its_texts():
    prefixes = {"remark": ("check", True), "degenerate": ("refused", False), "refused": ("refused", False)}
    asked = 0
    for name, keys in _calls():
        if name not in prefixes:
            continue
        prefix, advice = prefixes[name]
        for key in keys[1:] or keys:
            asked += 1
            assert TEXTS.has(f"{prefix}.{key}"), key
            assert not advice or TEXTS.has(f"{prefix}.{key}_do"), key
    for path in (CODE / "checks").glob("[a-z]*.py"):
        assert TEXTS.has(f"check.{path.stem}") or "remark(CHECK.key)" not in path.read_text(), path.stem
    assert asked > 20


def test_nothing_is_put_into_english_words_where_it_is_found():
    """A finding or refusal of base frames is made by the texts, never of a sentence in the code."""
    written = [
        (path.name, node.lineno)
        for path in sorted(CODE.rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call)
        and getattr(node.func, "id", "")
        in ("Warning_", "ActionRefusedError", "DegenerateGeometryError", "TooFewPointsError")
    ]
    assert not written


@pytest.mark.parametrize("language", OTHERS)
def test_every_language_has_every_sentence_with_the_same_fields_in_the_same_form(language):
    english, other = TEXTS.languages[FALLBACK], TEXTS.languages[language]
    assert sorted(english) == sorted(other)
    assert not unlike(english, other)


def test_a_text_that_is_missing_is_found(monkeypatch):
    """The test above fails where a language lacks one key, or says another field."""
    whole = TEXTS.languages
    lacking = {**whole, "zh": {k: v for k, v in whole["zh"].items() if k != "check.noise"}}
    monkeypatch.setitem(TEXTS.__dict__, "languages", lacking)
    with pytest.raises(AssertionError):
        test_every_language_has_every_sentence_with_the_same_fields_in_the_same_form("zh")


def test_every_chinese_sentence_is_chinese():
    for key, text in TEXTS.languages["zh"].items():
        fields = {name: WORDS.get(name, 1.0) for name, _ in FIELD.findall(text)}
        said = Phrase(TEXTS, key, fields).text("zh")
        left = english_left(said, ("N1", "ur10e", "a.csv", "--robot"))
        assert not left, (key, left)
        assert CHINESE.search(said) or key.startswith(("list.", "warning.")) or key == "report.rms", key


def _said(result):
    page = result.to_text("zh")
    return [line for line in page.splitlines() if not line.lstrip().startswith("T_")]


@pytest.mark.parametrize(
    "case", ["short", "outlier", "moved", "swapped", "noise", "few", "side", "described"]
)
def test_a_run_with_remarks_speaks_chinese(tmp_path, case):
    first, second, truth, towards = cell(14 if case == "moved" else 3)
    keys, axes = [], (1, 2)
    if case == "short":
        first = first[:6]
    elif case == "outlier":
        first[9] += [2.0, -1.0, 1.5]
    elif case == "moved":
        first[20:] += 0.6 * truth[:3, 2]
    elif case == "swapped":
        axes, keys = (2, 1), [f"towards_workspace_mm: [{', '.join(f'{v:.1f}' for v in towards)}]"]
    elif case == "noise":
        keys = ["noise_mm: 0.001"]
    elif case == "few":
        first = first[::14]
    elif case == "side":
        keys = [f"towards_workspace_mm: [{', '.join(f'{v:.4f}' for v in truth[:3, 3])}]"]
    else:
        keys = ["robot: ur10e"]
    result = run_base([write(tmp_path / "a.csv", first, second, keys=keys, axes=axes)])
    assert isinstance(result, ArcResult) and result.bases[0].warnings
    names = (
        "a.csv",
        "Universal Robots UR10e",
        "base",
        "flange",
        *(f"! {w.code}" for w in result.bases[0].warnings),
    )
    left = {line: english_left(line, names) for line in _said(result)}
    assert not [line for line, words in left.items() if words], left
    assert all(w.said(FALLBACK) == str(w) for w in result.bases[0].warnings)


def test_two_files_speak_chinese_too(tmp_path):
    first, second, _, _ = cell()
    path = write(tmp_path / "a.csv", first, second)
    result = run_base([path, path])
    assert not english_left("".join(_said(result)), ("a.csv",))


def test_refusals_of_points_and_of_the_wizard_speak_chinese(tmp_path):
    first, second, _, _ = cell()
    wizard = BaseWizard(steps(2))
    refusals = []
    for points in (first[:1], first[:2], np.ones((10, 3)), np.concatenate([first, first[::-1]])):
        with pytest.raises(DegenerateGeometryError) as geometry:
            run_base([write(tmp_path / "a.csv", points, second)])
        refusals.append(geometry.value)
    for act in (wizard.advance, wizard.undo, lambda: wizard.record(np.ones(3)), lambda: wizard.solve((), ())):
        with pytest.raises(ActionRefusedError) as refused:
            act()
        refusals.append(refused.value)
    for refusal in refusals:
        assert not english_left(refusal.said.text("zh")), refusal
        assert str(refusal.said) in str(refusal)


def test_a_finding_without_phrases_would_not_pass():
    """The tests above can fail: a warning that was written in English says so."""
    bare = Warning_("noise", "the points lie apart", "look again")
    assert english_left(bare.said("zh"))
    assert not english_left(remark("noise", axis=1, times=2.0, rms=0.1).said("zh"))
