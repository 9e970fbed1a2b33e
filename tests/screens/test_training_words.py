"""Texts of exercises and sessions whose keys are put together: every one of them is there, in every language."""

import ast
import inspect
import re
import typing

import pytest

from app.screens._training import cards
from app.session.actions import AnyAction
from app.texts import has_text, languages
from app.training import advice
from app.training.exercise import ANSWERS, Aims, exercises
from app.training.levels import LEVELS
from app.training.score import WEIGHTS


def _advised():
    """Codes that stand in the code as Advice("…")."""
    for node in ast.walk(ast.parse(inspect.getsource(advice))):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Advice":
            first = node.args[0]
            if isinstance(first, ast.Constant):
                yield first.value
    yield from (f"look_{answer}" for answer in ANSWERS)


def _keys():
    yield from (f"sessions.do_{kind.__struct_config__.tag}" for kind in typing.get_args(AnyAction))
    yield from (f"training.advice_{code}" for code in _advised())
    yield from (f"training.answer_{answer}" for answer in ANSWERS)
    yield from (f"training.part_{part}" for part in WEIGHTS)
    yield from (f"training.figure_{name}" for name, _ in cards._FIGURES)
    yield from (f"training.help_{name}" for name in cards._HELPS)
    yield from (f"training.level_{level}" for level in LEVELS)
    yield from (f"training.aim_{name}" for name in Aims.__struct_fields__)
    yield from (f"training.where_{e.goal}" for e in exercises().values())
    yield from (
        f"training.number_{e.question.number}"
        for e in exercises().values()
        if e.question and e.question.number
    )


@pytest.mark.parametrize("language", list(languages()))
def test_every_text_that_is_put_together_is_there(language):
    missing = sorted({key for key in _keys() if not has_text(key, language)})
    assert not missing, missing


def test_every_refusal_of_the_session_can_be_said_in_chinese():
    from app.session import refusals

    plain = {"cannot_solve", "unknown"}  # these hand on a sentence that is translated elsewhere
    missing = [
        code for code in refusals._SENTENCES if code not in plain and not has_text(f"refused.{code}", "zh")
    ]
    assert not missing, missing


def test_exercises_say_nothing_of_their_answer_in_their_title():
    for chosen in exercises().values():
        title = chosen.said("en").title.lower()
        if chosen.question and chosen.question.answer not in ("", "nothing"):
            assert not re.search(r"bent|zero|gearbox|moved|another", title), chosen.key
