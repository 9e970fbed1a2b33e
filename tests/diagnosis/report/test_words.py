"""What a diagnosis is said in: every word in every language, and the same fields."""

import ast
import re
from pathlib import Path

from app import catalog, diagnosis
from app.diagnosis.effects.dynamic import wrong_convention
from app.diagnosis.report.wording import WORDS, effect_title, finding_sentence, place, verdict_sentence
from tests.diagnosis.report.cases import static_case
from tests.translations import unlike

HAN = re.compile(r"[\u4e00-\u9fff]")


def test_every_word_is_there_in_every_language_with_its_fields():
    english = WORDS.languages["en"]
    for language, words in WORDS.languages.items():
        assert not unlike(english, words), language


def test_every_effect_has_a_name_in_every_language():
    for family in ("kinematic", "dynamic"):
        for key in catalog.members(f"app.diagnosis.effects.{family}", "EFFECT"):
            assert WORDS.has(f"effect.{key}"), key
            assert HAN.search(effect_title(key, "zh")), key


def test_a_verdict_and_a_finding_are_said_in_chinese_without_a_word_of_english():
    case = static_case()
    finding = case.findings[0]
    said = verdict_sentence(case, "zh") + place(finding.where, "zh") + finding_sentence(finding, "zh")
    assert HAN.search(said)
    assert not re.search(r"[A-Za-z]{6,}", said), said
    assert finding_sentence(finding, "en") == finding.sentence


def _places():
    """Every pair of a place's key and what is written for it that the effects' source holds; None for what is not."""
    for path in (Path(diagnosis.__file__).parent / "effects").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if (
                isinstance(node, ast.Call)
                and getattr(node.func, "id", "") in ("Place", "_place")
                and node.args
            ):
                where = node.args[0]
                for key, value in (
                    zip(where.keys, where.values, strict=True) if isinstance(where, ast.Dict) else ()
                ):
                    if isinstance(key, ast.Constant):
                        yield key.value, value.value if isinstance(value, ast.Constant) else None


def test_every_part_of_a_place_is_said_in_chinese():
    found = {(key, value) for key, value in _places() if key not in ("axis", "kind")}
    found |= {("kind", name) for name in wrong_convention._NAMES.values()}
    found |= {("driver", name) for name in ("space", "speed", "acceleration", "temperature", "pose")}
    assert {"order", "driver", "body", "joint"} <= {key for key, _ in found}
    for key, value in found:
        said = place({key: value if isinstance(value, str) else 2}, "zh")
        assert HAN.search(said), (key, value, said)
        assert not re.search(r"[A-Za-z]{3,}", said), (key, value, said)


def test_joints_whose_columns_are_changed_over_do_not_move_each_other():
    where = {"joint": 2, "source_joint": 3, "kind": "torque_order"}
    assert place(where) == "joint 2, with joint 3, their torques changed over"
    assert place(where, "zh") == "关节 2、与关节 3、力矩列互换"
