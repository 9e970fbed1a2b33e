"""An exercise made in a page: its fields -> its file, or what is wrong with them, a line each. Pure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.classroom.assignments import HELPS
from app.errors import TeachframeError
from app.kinematics import robot_names
from app.phrases import Phrase
from app.session.state import mode_named, robot_named
from app.simulation.tracker_cell import make_cell
from app.texts import TEXTS, error_text
from app.training.cell import at_touch
from app.training.exercise import (
    Aims,
    Allowed,
    Exercise,
    FaultPart,
    Hidden,
    Question,
    Words,
    exercise_text,
    parse_exercise,
)
from app.training.truth import draw

#: Wizard modes that can be taught at the spike.
MODES = ("touch", "touch_z", "touch_xy", "touch_zx", "touch_many")
GOALS = ("tool", "touch")
ACTIVE = ("none", "right", "wrong")
#: What can be wrong, as a trainee may answer.
WRONG = ("nothing", "bent_tip", "spike_moved", "joint_zero", "soft_gearbox", "wrong_tool")
_SEEDS = 3  # cells that are drawn to see that the exercise can be done at all
_TITLE, _TEXT = 80, 600  # characters

#: name -> (what it is without a word, least, most, the reason of the bounds is in the comment).
NUMBERS: dict[str, tuple[float, float, float]] = {
    "touches": (4, 1, 30),  # the mode says more exactly
    "difficulty": (2, 1, 5),
    "tool_spread_mm": (8, 0, 60),  # more, and the tip may lie in the flange
    "tool_turn_deg": (0, 0, 20),  # as far as strokes along the drawn axes still are near the true ones
    "spike_spread_mm": (25, 0, 80),  # the spike stays on the table, within reach
    "touch_noise_mm": (0.15, 0, 2),
    "wrong_by_mm": (14, 2, 60),  # less is no other tool
    "bent_mm": (3.5, 0.5, 20),
    "moved_mm": (3.5, 0.5, 20),
    "from_touch": (3, 2, 20),
    "to_touch": (4, 2, 20),
    "joint": (3, 1, 12),
    "zero_deg": (0.3, 0.02, 3),
    "soft_urad": (14, 1, 500),  # microradians per newton-metre
    "load_kg": (0, 0, 300),
    "load_x_mm": (0, -1000, 1000),
    "load_y_mm": (0, -1000, 1000),
    "load_z_mm": (0, -1000, 1500),
    "aim_mm": (0.6, 0.05, 20),
    "aim_deg": (0.4, 0.05, 10),
    "minutes": (10, 1, 120),
    "travel_m": (0, 0, 200),
}
WHOLE = ("touches", "difficulty", "from_touch", "to_touch", "joint")
TEXTS_ASKED = tuple(f"{part}_{language}" for language in ("en", "zh") for part in ("title", "task", "learn"))


@dataclass(frozen=True)
class Draft:
    """What came of the fields.

    Args:
        text: the file; empty where something is wrong.
        mistakes: what is, a line each.
    """

    text: str
    mistakes: tuple[Phrase, ...] = ()


def usual() -> dict[str, str]:
    """The fields of a page that is opened anew."""
    fields = {name: f"{value:g}" for name, (value, _, _) in NUMBERS.items()}
    fields |= {"robot": "ur10e", "goal": "tool", "mode": "touch", "wrong": "nothing", "active": "none"}
    return fields | dict.fromkeys(TEXTS_ASKED, "") | {f"help_{name}": "on" for name in HELPS}


def drafted(fields: Mapping[str, str], language: str) -> Draft:
    """The file of the exercise these fields describe, or their mistakes."""
    numbers, mistakes = _numbers(fields)
    words = {name: " ".join(fields.get(name, "").split()) for name in TEXTS_ASKED}
    for part in ("title", "task", "learn"):  # what is written in one language alone stands in both
        given = words[f"{part}_en"] or words[f"{part}_zh"]
        for tongue in ("en", "zh"):
            words[f"{part}_{tongue}"] = words[f"{part}_{tongue}"] or given
        most = _TITLE if part == "title" else _TEXT
        longest = max(len(words[f"{part}_{tongue}"]) for tongue in ("en", "zh"))
        if not given and part != "learn":
            mistakes.append(_mistake("no_text", field=_name(part)))
        elif longest > most:
            mistakes.append(_mistake("long_text", field=_name(part), given=longest, most=most))
    for name, known in (("robot", robot_names()), ("mode", MODES), ("goal", GOALS), ("wrong", WRONG)):
        if fields.get(name) not in known:
            mistakes.append(_mistake("choice", field=_name(name), value=str(fields.get(name, ""))[:40]))
    if fields.get("active", "none") not in ACTIVE:
        mistakes.append(_mistake("choice", field=_name("active"), value=str(fields.get("active"))[:40]))
    if not mistakes:
        mistakes += _together(fields, numbers)
    if mistakes:
        return Draft("", tuple(mistakes))
    text = exercise_text(_exercise(fields, numbers, words))
    return Draft(text, tried(text, language))


def tried(text: str, language: str) -> tuple[Phrase, ...]:
    """What is wrong with a file: it is read, and a few of its cells are drawn; () where all of that goes well."""
    try:
        made = parse_exercise(text, "exercise", "exercise")
        for seed in range(_SEEDS):
            if made.goal == "relation":
                first, second = made.hidden.robots
                make_cell(first, second, seed)
            else:
                world = at_touch(draw(made, seed), made.touches)
                if not np.all(np.isfinite(world.tip(world.robot.home).position)):
                    return (_mistake("no_cell"),)
    except TeachframeError as error:
        return (Phrase(TEXTS, "making.mistake_file", {"problem": error_text(error, language)}),)
    except (ValueError, TypeError, KeyError, IndexError, ArithmeticError) as error:
        return (
            Phrase(TEXTS, "making.mistake_file", {"problem": f"{type(error).__name__}: {str(error)[:120]}"}),
        )
    return ()


def _numbers(fields: Mapping[str, str]) -> tuple[dict[str, float], list[Phrase]]:
    numbers, mistakes = {}, []
    for name, (usual_value, low, high) in NUMBERS.items():
        written = fields.get(name, "").strip().replace(",", ".") or f"{usual_value:g}"
        try:
            value = float(written)
        except ValueError:
            value = float("nan")
        if not low <= value <= high or (name in WHOLE and value != int(value)):
            kind = "whole" if name in WHOLE else "number"
            mistakes.append(
                _mistake(kind, field=_name(name), value=written[:20], low=f"{low:g}", high=f"{high:g}")
            )
        else:
            numbers[name] = value
    return numbers, mistakes


def _together(fields: Mapping[str, str], numbers: Mapping[str, float]) -> list[Phrase]:
    """What each field may be, but not with the others."""
    mistakes, mode, wrong = [], mode_named(fields["mode"]), fields["wrong"]
    touches = int(numbers["touches"])
    if not mode.least_touches <= touches <= mode.most_touches:
        mistakes.append(
            _mistake(
                "whole",
                field=_name("touches"),
                value=touches,
                low=mode.least_touches,
                high=mode.most_touches,
            )
        )
    if wrong in ("bent_tip", "spike_moved"):
        if numbers["from_touch"] > numbers["to_touch"]:
            mistakes.append(_mistake("order"))
        elif numbers["to_touch"] > touches:
            mistakes.append(_mistake("late", last=int(numbers["to_touch"]), touches=touches))
    joints = robot_named(fields["robot"]).joint_count
    if wrong in ("joint_zero", "soft_gearbox") and numbers["joint"] > joints:
        mistakes.append(
            _mistake("whole", field=_name("joint"), value=int(numbers["joint"]), low=1, high=joints)
        )
    if wrong == "soft_gearbox" and not numbers["load_kg"]:
        mistakes.append(_mistake("no_load"))
    if wrong != "nothing" and fields["goal"] != "tool":
        mistakes.append(_mistake("goal"))
    return mistakes


def _exercise(fields: Mapping[str, str], numbers: Mapping[str, float], words: Mapping[str, str]) -> Exercise:
    wrong, tool = fields["wrong"], fields["goal"] == "tool"
    span = (int(numbers["from_touch"]), int(numbers["to_touch"]))
    turned = numbers["tool_turn_deg"]
    axes = tool and fields["mode"] not in ("touch", "touch_many")
    hidden = Hidden(
        tool_spread_mm=numbers["tool_spread_mm"],
        tool_turn_deg=turned,
        spike_spread_mm=numbers["spike_spread_mm"],
        touch_noise_mm=numbers["touch_noise_mm"],
        spike_moved_mm=numbers["moved_mm"] if wrong == "spike_moved" else 0.0,
        spike_from=span if wrong == "spike_moved" else Hidden().spike_from,
        active="wrong" if wrong == "wrong_tool" else fields.get("active", "none"),  # type: ignore[arg-type]
        wrong_by_mm=numbers["wrong_by_mm"],
        load_kg=numbers["load_kg"],
        load_centre_mm=(numbers["load_x_mm"], numbers["load_y_mm"], numbers["load_z_mm"]),
        faults=_faults(wrong, numbers, span),
    )
    asked = "on" in (fields.get("ask"), "on" if wrong != "nothing" else "")
    number: Any = {
        "bent_tip": "touch",
        "spike_moved": "touch",
        "joint_zero": "joint",
        "soft_gearbox": "joint",
    }
    question = Question(choices=WRONG, answer=wrong, number=number.get(wrong, "")) if asked else None
    return Exercise(
        key="exercise",
        order=1000,  # after the shipped ones
        difficulty=int(numbers["difficulty"]),
        goal="tool" if tool else "touch",
        robot=fields["robot"],
        mode=fields["mode"],
        touches=int(numbers["touches"]),
        words={
            tongue: Words(
                title=words[f"title_{tongue}"], task=words[f"task_{tongue}"], learn=words[f"learn_{tongue}"]
            )
            for tongue in ("en", "zh")
        },
        allowed=Allowed(**{name: fields.get(f"help_{name}") == "on" for name in HELPS}),
        hidden=hidden,
        question=question,
        aims=Aims(
            touch_mm=0.0 if tool else numbers["aim_mm"],
            tool_mm=numbers["aim_mm"] if tool else 0.0,
            axis_deg=numbers["aim_deg"] if axes else 0.0,
            minutes=numbers["minutes"],
            travel_m=numbers["travel_m"],
        ),
    )


def _faults(wrong: str, numbers: Mapping[str, float], span: tuple[int, int]) -> tuple[FaultPart, ...]:
    if wrong == "bent_tip":
        # Mostly across the tool: a blow bends it aside. Of the length that was asked for: 0.69^2 + 0.69^2 + 0.22^2 = 1.
        bent = numbers["bent_mm"]
        values = {"dx_mm": 0.69 * bent, "dy_mm": 0.69 * bent, "dz_mm": 0.22 * bent}
        return (FaultPart(effect="tool_slip", where={"body": "tool", "from_row": list(span)}, values=values),)
    joint = int(numbers["joint"])
    if wrong == "joint_zero":
        return (
            FaultPart(
                effect="joint_zero", where={"joint": joint}, values={"offset_deg": numbers["zero_deg"]}
            ),
        )
    if wrong == "soft_gearbox":
        return (
            FaultPart(
                effect="joint_compliance",
                where={"joint": joint, "driver": "gravity_torque"},
                values={"compliance_rad_Nm": numbers["soft_urad"] * 1e-6},
                signs=False,
            ),
        )
    return ()


def _mistake(code: str, **fields: object) -> Phrase:
    return Phrase(TEXTS, f"making.mistake_{code}", fields)


def _name(field: str) -> Phrase:
    return Phrase(TEXTS, f"making.{field}")
