"""What readers of files say reaches an operator in their own language; a sentence without a translation is found."""

import ast
import re
from pathlib import Path

import pytest

import app
from app.errors import CellValueError, FileFormatError, UnknownNameError
from app.recordings import read_table
from app.texts import error_text
from app.texts.of_files import sentence, shapes
from tests.chinese import CHINESE

ROOT = Path(app.__file__).parent
#: Whatever a file sent from the browser goes through.
READERS = (
    "recordings",
    "calibration/exchange",
    "calibration/base",
    "kinematics",
    "diagnosis/kinematic",
    "diagnosis/dynamic",
    "diagnosis/observations",
)
SINGLE = ("calibration/points.py", "calibration/captures.py", "diagnosis/dispatch.py", "diagnosis/doubts.py")
ERRORS = {"InputError", "FileFormatError", "MissingColumnError", "UnitError", "CellValueError"}
#: Beside prose: what is typed as it stands, and shapes that hold nothing but what was found.
TYPED = re.compile(
    r"[^a-z]*|\{\}.?.?\{\}|.*[=<\[\]].*|X: .*|kind: arcs|[a-z_{} or]*_[a-z{}_ or]*|CSV|motion|it beside \{\}"
)


def _shapes(node):
    """The shapes a message can have."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return [node.value]
    if isinstance(node, ast.JoinedStr):
        return ["".join(str(p.value) if isinstance(p, ast.Constant) else "{}" for p in node.values)]
    if isinstance(node, ast.IfExp):
        return _shapes(node.body) + _shapes(node.orelse)
    if isinstance(node, ast.BinOp):
        return [a + b for a in _shapes(node.left) or ["{}"] for b in _shapes(node.right) or ["{}"]]
    return []


def _said():
    for path in [p for r in READERS for p in sorted((ROOT / r).rglob("*.py"))] + [ROOT / s for s in SINGLE]:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ERRORS:
                expected = [k.value for k in node.keywords if k.arg == "expected"]
                for part in (*node.args[:1], *expected):
                    yield from ((path.name, shape) for shape in _shapes(part))


def test_every_sentence_of_a_reader_has_a_chinese_one():
    known = shapes("zh")
    said = set(_said())
    missing = sorted((f, s) for f, s in said if s not in known and not TYPED.fullmatch(s))
    assert len(said) > 120 and not missing, missing


def test_every_chinese_sentence_takes_up_all_that_was_found():
    wrong = [
        shape
        for shape, text in shapes("zh").items()
        if {int(n) for n in re.findall(r"\{(\d)\}", text)} != set(range(shape.count("{}")))
    ]
    assert not wrong


@pytest.mark.parametrize(
    "language, says", [("zh", "a.csv、第 3 行、列 z_mm：单元格为空；应为：有限的数字"), ("xx", "row 3")]
)
def test_a_cell_is_named_by_its_place(language, says):
    error = CellValueError(
        "the cell is empty", file="/somewhere/a.csv", row=3, column="z_mm", expected="a finite number"
    )
    assert says in error_text(error, language)
    assert error_text(error, "en") == str(error).replace("/somewhere/", "")


def test_a_real_file_that_is_none_is_refused_in_chinese(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("", encoding="utf-8")
    with pytest.raises(FileFormatError) as refused:
        read_table(path)
    said = error_text(refused.value, "zh")
    assert CHINESE.search(said) and "a.csv" in said and not re.search(r"\b(the|row|file|header)\b", said)
    unknown = error_text(UnknownNameError("ur10x", available=["ur10e"], what="robot"), "zh")
    assert "是否指 ur10e" in unknown and "expected" not in unknown


def test_what_has_no_translation_stays_as_it_is():
    assert sentence("the moon is full", "zh") == "the moon is full"
