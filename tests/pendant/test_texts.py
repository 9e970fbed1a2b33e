import ast
import re
from pathlib import Path

import pytest

from app.pendant import texts
from app.pendant.texts import FALLBACK, languages

PENDANT = Path(texts.__file__).parents[1]
FIELD = re.compile(r"{(\w+)}")


def _constant_keys():
    """Every text key that stands in the code as it is: t("…") and text("…")."""
    for path in sorted(PENDANT.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call) or not node.args:
                continue
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            first = node.args[0]
            if name in ("t", "text") and isinstance(first, ast.Constant) and isinstance(first.value, str):
                yield path.name, first.value


def test_every_text_the_code_asks_for_is_there():
    missing = [(file, key) for file, key in _constant_keys() if not texts.has_text(key, FALLBACK)]
    assert not missing, missing


@pytest.mark.parametrize("language", [key for key in languages() if key != FALLBACK])
def test_every_language_has_every_text(language):
    missing = [key for key in texts.TEXTS.languages[FALLBACK] if not texts.has_text(key, language)]
    assert not missing, missing


@pytest.mark.parametrize("language", [key for key in languages() if key != FALLBACK])
def test_a_translation_has_the_same_fields(language):
    english, other = texts.TEXTS.languages[FALLBACK], texts.TEXTS.languages[language]
    wrong = [
        k for k in english if k in other and set(FIELD.findall(other[k])) != set(FIELD.findall(english[k]))
    ]
    assert not wrong, wrong


def test_a_text_that_is_missing_in_a_language_comes_in_english():
    assert texts.text("tool.title", "xx") == texts.text("tool.title")


def test_an_unknown_text_is_an_error():
    with pytest.raises(KeyError):
        texts.text("no.such.text")
