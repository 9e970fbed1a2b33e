"""A saved model is data from anywhere: before anything is computed with it, its numbers and places are looked at.

Two steps. `checked` needs nothing but the model: sizes, types, finite numbers, places that effects of this name have.
`fitting` has the arm beside it: joints and links that it has.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from app.diagnosis import effects
from app.diagnosis.model import ModelEffect, SavedModel
from app.errors import CellValueError, InputError, UnknownNameError
from app.kinematics import RobotModel

KINDS = ("static", "motion")
#: Nobody finds more effects than this on one arm; a file that holds more is none that was saved here.
MOST_EFFECTS = 1000
#: Parameters of one effect, and numbers of one nuisance entry (targets of a long recording).
MOST_PARAMETERS, MOST_NUMBERS = 200, 1_000_000
#: Beyond this no parameter in SI units means anything: masses, lengths, stiffnesses, times of one arm.
LARGEST = 1e9
LONGEST_TEXT = 300
#: Keys of `where` that hold a number from 1; the others hold a time or a word.
_COUNTED = ("joint", "link", "source_joint", "from_row", "order")
_TIMES = ("from_s", "to_s")


def checked(model: SavedModel, file: str | Path | None = None) -> SavedModel:
    """The same model.

    Raises:
        InputError: its first part that cannot be used, by effect and key.
    """
    if model.kind not in KINDS:
        raise UnknownNameError(model.kind[:40], available=KINDS, what="kind of model", file=file)
    if len(model.effects) > MOST_EFFECTS:
        raise InputError(f"{len(model.effects)} effects", file=file, expected=f"at most {MOST_EFFECTS}")
    for text, name in ((model.robot, "robot"), (model.source, "source")):
        if len(text) > 10 * LONGEST_TEXT:
            raise InputError("this text is too long", file=file, column=name, expected="a name or a path")
    for number, effect in enumerate(model.effects, 1):
        _check_effect(effect, model.kind, f"effect {number} ({effect.effect[:40]})", file)
    taught = model.taught
    for name, values in (
        ("lowest", taught.lowest),
        ("highest", taught.highest),
        *(("poses", p) for p in taught.poses),
    ):
        if not all(abs(v) <= LARGEST for v in values):
            raise InputError("not a list of finite numbers", file=file, column=f"taught {name}")
    if not math.isfinite(taught.heldout_rms) or len(taught.poses) > MOST_NUMBERS:
        raise InputError("found what cannot be", file=file, column="taught", expected="finite numbers")
    for name, numbers in model.nuisance.items():
        if len(numbers) > MOST_NUMBERS or not all(math.isfinite(v) for v in numbers):
            raise InputError("not a list of finite numbers", file=file, column=f"nuisance {name[:40]}")
    return model


def fitting(
    model: SavedModel, robot: RobotModel, kind: str | None = None, file: str | Path | None = None
) -> SavedModel:
    """The same model, if this arm has the joints and links it speaks of.

    Args:
        kind: static or motion, what the recording beside it is; None where there is none.
        file: the recording.

    Raises:
        InputError: another kind, or the first place that this arm has not.
    """
    if kind is not None and model.kind != kind:
        raise InputError(
            f"the model given was learnt from {model.kind} recordings and this one is of kind {kind}",
            file=file,
            expected=f"a model of kind {kind}",
        )
    for number, effect in enumerate(checked(model, file).effects, 1):
        for key in ("joint", "source_joint", "link"):
            value = effect.where.get(key)
            if value is not None and value > robot.joint_count:
                raise CellValueError(
                    f"found {value}",
                    file=file,
                    column=f"effect {number} ({effect.effect[:40]}), where {key}",
                    expected=f"1 to {robot.joint_count}, as {robot.name} has",
                )
    return model


@contextmanager
def applying(model: SavedModel | None, file: str | Path | None = None) -> Iterator[None]:
    """Around whatever computes with a model from a file: an effect without its parameters, or with a place that its law
    does not have, is the file's mistake. Nothing is caught where there is no model.

    Raises:
        InputError: what was missing.
    """
    try:
        yield
    except (KeyError, TypeError, ValueError, IndexError, ArithmeticError) as error:
        if model is None or os.environ.get("TEACHFRAME_DEBUG"):
            raise
        raise InputError(
            f"the model cannot be applied ({type(error).__name__}: {str(error)[:80]})",
            file=file,
            expected="every effect with its place and its parameters",
        ) from None


def _check_effect(effect: ModelEffect, kind: str, what: str, file: str | Path | None) -> None:
    if not effect.effect or len(effect.effect) > LONGEST_TEXT:
        raise InputError("an effect without a name", file=file, column=what[:80], expected="a name")
    law = effects.named(effect.effect, kind)
    for key in () if law is None else law.located_by:
        if key not in effect.where:
            raise InputError("this key is missing", file=file, column=f"{what}, where", expected=key)
    for key, value in effect.where.items():
        expected = _expected(key, value)
        if expected:
            raise CellValueError(
                f"found {str(value)[:40]!r}", file=file, column=f"{what}, where {key[:40]}", expected=expected
            )
    if len(effect.parameters) > MOST_PARAMETERS:
        raise InputError(f"{len(effect.parameters)} parameters", file=file, column=what)
    for name, value in effect.parameters.items():
        if not abs(value) <= LARGEST:
            raise CellValueError(
                f"found {value!r}",
                file=file,
                column=f"{what}, parameter {name[:40]}",
                expected=f"a finite number of at most {LARGEST:g}",
            )
    impossible = None if law is None else law.impossible(effect.parameters)
    if impossible is not None:
        name, expected = impossible
        raise CellValueError(
            f"found {effect.parameters[name]!r}", file=file, column=f"{what}, {name}", expected=expected
        )


def _expected(key: str, value: Any) -> str:
    """What this key of a place should hold; "" where it does."""
    if key in _COUNTED:
        whole = isinstance(value, int) and not isinstance(value, bool) and 1 <= value < 2**31
        return "" if whole else "a whole number from 1"
    if key in _TIMES:
        timed = isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e12
        return "" if timed else "a time in seconds"
    if isinstance(value, str):
        return "" if len(value) <= LONGEST_TEXT else "a shorter text"
    plain = value is None or (isinstance(value, int | float) and abs(value) <= LARGEST)
    return "" if plain else "a number or a text"
