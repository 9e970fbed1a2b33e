"""What a diagnosis is said in: every word in every language, and the same fields."""

import re

from app import catalog
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
