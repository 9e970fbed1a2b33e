import ast
import re
from pathlib import Path

import pytest

from app import texts
from app.texts import FALLBACK, languages
from tests.translations import unlike

APP = Path(texts.__file__).parents[1]
#: Where the pendant speaks.
SPEAKING = ("session/motion", "screens", "scene", "workers", "shell", "texts")
FIELD = re.compile(r"{(\w+)}")
#: Strings of the shape `tool.urdf` are files.
FILES = (".urdf", ".csv", ".toml", ".json", ".html", ".py", ".db", ".yaml")
#: Methods whose strings name a slot or a motion, not a text.
SLOTTED = ("latest", "changed", "animate", "halt", "running", "startswith")
#: Names that are the same in every language.
NAMES = ("tool.own_words",)


def _files():
    return sorted(path for place in SPEAKING for path in (APP / place).rglob("*.py"))


def _constant_keys():
    """Every text key that stands in the code as it is: t("…") and text("…")."""
    for path in _files():
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call) or not node.args:
                continue
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            first = node.args[0]
            if name in ("t", "text") and isinstance(first, ast.Constant) and isinstance(first.value, str):
                yield path.name, first.value


def _written():
    """Every string, and every f-string as a pattern, that stands in the code of the pendant."""
    for path in _files():
        tree = ast.parse(path.read_text(encoding="utf-8"))
        slots = {
            argument
            for node in ast.walk(tree)
            if isinstance(node, ast.Call) and getattr(node.func, "attr", "") in SLOTTED
            for argument in node.args
        }
        for node in ast.walk(tree):
            if node in slots:
                continue
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                yield path.name, re.escape(node.value), node.value
            elif isinstance(node, ast.JoinedStr):
                parts = [p.value if isinstance(p, ast.Constant) else None for p in node.values]
                pattern = "".join(r"\w+" if p is None else re.escape(p) for p in parts)
                yield path.name, pattern, "".join("{}" if p is None else p for p in parts)


def test_whatever_looks_like_a_key_is_one_wherever_it_stands():
    """Keys in tables, in conditions and with a part filled in: `jog.frame_{}` needs a text that fits."""
    keys = texts.TEXTS.languages[FALLBACK]
    sections = "|".join(sorted({key.split(".")[0] for key in keys}))
    like_a_key = re.compile(rf"({sections})\.[a-z0-9_{{}}]*[a-z0-9}}]")
    missing = [
        (file, seen)
        for file, pattern, seen in _written()
        if like_a_key.fullmatch(seen)
        and not seen.endswith(FILES)
        and not any(re.fullmatch(pattern, key) for key in keys)
    ]
    assert not missing, missing


def test_nothing_chinese_is_still_english():
    english, chinese = texts.TEXTS.languages["en"], texts.TEXTS.languages["zh"]
    same = [
        key
        for key, words in english.items()
        if chinese.get(key) == words and re.search(r"[A-Za-z]{3,}", FIELD.sub("", words)) and key not in NAMES
    ]
    assert not same, same


def test_what_is_chinese_has_chinese_in_it():
    english, chinese = texts.TEXTS.languages["en"], texts.TEXTS.languages["zh"]
    latin = [
        key
        for key, words in chinese.items()
        if len(re.findall(r"[A-Za-z]{3,}", FIELD.sub("", english.get(key, "")))) >= 2
        and not re.search("[\u4e00-\u9fff]", words)
        and key not in NAMES
    ]
    assert not latin, latin


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
    wrong = unlike(english, other)
    assert not wrong, wrong


def test_a_text_that_is_missing_in_a_language_comes_in_english():
    assert texts.text("tool.title", "xx") == texts.text("tool.title")


def test_an_unknown_text_is_an_error():
    with pytest.raises(KeyError):
        texts.text("no.such.text")
