"""What engines remark is there in every language, and reaches the reader in their own."""

import ast
import json
import pickle
from pathlib import Path

import pytest

import app.diagnosis
from app import catalog
from app.diagnosis.report.wording import finding_law, parameter_name
from app.diagnosis.result import Finding
from app.diagnosis.wording import (
    WORDS,
    effect,
    in_words,
    joint_or_arm,
    joints,
    note,
    reason,
    remark_of_reasons,
)
from app.phrases import FALLBACK
from app.recordings.wording import WORDS as recording_words
from tests.chinese import CHINESE, english_left
from tests.source import parsed
from tests.translations import FIELD, unlike

CODE = Path(app.diagnosis.__file__).parent
OTHERS = [language for language in WORDS.languages if language != FALLBACK]
FAMILIES = {"note": "note", "reason": "withheld"}
#: Beside units: symbols of laws, options, file keys, a name.
SYMBOLS = {
    "tau", "sin", "cos", "sign", "exp", "Stribeck", "alpha", "beta", "reference", "kind", "t_s", "t0", "mrad",
    *("q_", "p_", "T_", "x_", "z_", "tau_"), *"adgtqkxJTz", *("qd", "qdd"),
}  # fmt: skip


def _english(said):
    return [word for word in english_left(said) if word not in SYMBOLS]


def _trees():
    for path in sorted(CODE.rglob("*.py")):
        yield path, parsed(path)


def _name(call):
    return getattr(call.func, "id", getattr(call.func, "attr", "")) if isinstance(call, ast.Call) else ""


def test_every_remark_the_code_asks_for_is_there():
    asked = set()
    for path, tree in _trees():
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and _name(node) in FAMILIES and node.args:
                keys = [
                    n.value for n in ast.walk(node.args[0]) if isinstance(n, ast.Constant) and n.value != 1
                ]
                if not isinstance(node.args[0], ast.JoinedStr):
                    asked |= {(path.name, f"{FAMILIES[_name(node)]}.{key}") for key in keys}
    missing = [(file, key) for file, key in sorted(asked) if not WORDS.has(key)]
    assert len(asked) > 40 and not missing


def test_no_remark_is_put_into_words_where_it_is_made():
    """What goes into a list of notes is a note, not a sentence."""
    written = [
        (path.name, node.lineno)
        for path, tree in _trees()
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and _name(node) == "append"
        and getattr(node.func, "value", None) is not None
        and getattr(node.func.value, "id", "") in ("notes", "reasons")  # type: ignore[attr-defined]
        and _name(node.args[0]) != "note"
    ]
    assert not written


@pytest.mark.parametrize("texts", [WORDS, recording_words])
@pytest.mark.parametrize("language", OTHERS)
def test_every_language_has_every_word_with_the_same_fields_in_the_same_form(language, texts):
    english, other = texts.languages[FALLBACK], texts.languages[language]
    assert not unlike(english, other)


def test_every_chinese_remark_and_law_is_chinese():
    for key, text in WORDS.languages["zh"].items():
        if not key.startswith(("note.", "withheld.", "law.")) or key in ("note.as_it_is", "note.and_then"):
            continue
        said = FIELD.sub("", text)
        assert CHINESE.search(said) or key == "note.law_at", key
        assert not _english(said), (key, _english(said))


def test_what_looks_for_english_finds_it():
    assert _english("q_true = q + offset")
    assert _english(str(note("masses_assumed")))


@pytest.mark.parametrize("family", ["kinematic", "dynamic"])
def test_every_law_is_said_in_chinese(family):
    for key, found in catalog.members(f"app.diagnosis.effects.{family}", "EFFECT").items():
        finding = Finding(key, {}, (), 1.0, 0.0, 1.0, 1.0, (), "", found.equation)
        assert finding_law(finding) == found.equation
        said = finding_law(finding, "zh")
        # A law of symbols alone reads the same everywhere.
        assert said != found.equation and not _english(said), key
        for name in getattr(found, "units", ()):
            assert len(name) <= 2 or CHINESE.search(parameter_name(name, "zh")), (key, name)


def test_a_remark_is_its_english_sentence_and_remembers_itself():
    said = note("reflector_lost", number=2, count=25, total=50)
    assert said == "reflector 2 was lost in 25 of 50 rows" and json.loads(json.dumps([said])) == [said]
    again = pickle.loads(pickle.dumps(said))  # between processes, as several files at once are diagnosed
    assert again == said and in_words(again, "zh") == "反射球 2 在 50 行中有 25 行丢失"
    assert in_words("a sentence of somebody else's", "zh") == "a sentence of somebody else's"


def test_names_that_are_withheld_are_one_remark_with_each_reason_once():
    shaky, unlawful = reason("leftover_joint"), reason("unlawful")
    laws = [("viscous_friction", 1, shaky), ("coulomb_friction", 2, shaky), ("delay", None, unlawful)]
    one = remark_of_reasons([(effect(e), joint_or_arm(j), why) for e, j, why in laws[:1]])
    assert one == (
        "viscous_friction at joint 1 is withheld: more is left over on this joint than it explains",
    )
    (said,) = remark_of_reasons([(effect(e), joint_or_arm(j), why) for e, j, why in laws])
    assert said == (
        "3 laws are withheld: viscous_friction at joint 1, coulomb_friction at joint 2 (more is left over on this "
        "joint than it explains); delay at the arm (its values are none a real arm has)"
    )
    assert not _english(in_words(said, "zh"))
    assert remark_of_reasons([]) == ()
    assert in_words(note("above_curves", joints=joints([1, 3]), sizes=("1.20", "3.00")), "zh").startswith(
        "关节 1、3："
    )
