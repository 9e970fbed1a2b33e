"""What is said of an exercise: before it, while it runs, and after."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from app.kinematics import load_robot
from app.pendant import html
from app.session.state import Running
from app.training.exercise import Exercise, exercise
from app.training.score import ScoreCard

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_HELPS = ("distance", "closeup", "next_touch", "handle", "touch")
#: Figures on the card, in their order, with the digits they are shown with.
_FIGURES = (
    ("tool_mm", 2), ("residual_mm", 2), ("sigma_mm", 2), ("axis_deg", 2), ("touch_mm", 2), ("meeting_mm", 2),
    ("predicted_mm", 2), ("relation_mm", 2), ("relation_deg", 3), ("records", 0), ("repeats", 0), ("calculations", 0),
    ("travel_m", 1), ("near_misses", 0), ("closest_mm", 0),
)  # fmt: skip
_GOOD, _FAIR = 0.8, 0.5  # shares of a part from which its bar is green, yellow
_FULL_BAR = 80  # px


def title(pendant: Pendant, chosen: Exercise, best: float | None) -> str:
    """One line of the list: difficulty as stars, the best score so far."""
    stars = "★" * chosen.difficulty + "☆" * (5 - chosen.difficulty)
    reached = f"  ·  {best:.0f}" if best is not None else ""
    return f"{stars}  {chosen.said(pendant.language).title}{reached}"


def before(pendant: Pendant, chosen: Exercise) -> str:
    """What it is about, what helps, what is good."""
    t, words = pendant.t, chosen.said(pendant.language)
    robots = chosen.hidden.robots or (chosen.robot,)
    names = " + ".join(load_robot(name).said("title", pendant.language) for name in robots)
    rows = [(t("training.robot"), names), (t("training.good"), _aims(pendant, chosen))]
    if chosen.goal != "relation":
        rows.append((t("training.helps"), _helps(pendant, chosen)))
    return (
        html.instruction(words.title, words.task)
        + html.paragraph(words.learn, faint=True, testid="exercise-learn")
        + html.table(rows, testid="exercise-facts", widths=("24%", "76%"))
    )


def _aims(pendant: Pendant, chosen: Exercise) -> str:
    t, aims = pendant.t, chosen.aims
    found = [
        t(f"training.aim_{name}", value=f"{value:g}")
        for name, value in (
            ("touch_mm", aims.touch_mm),
            ("tool_mm", aims.tool_mm),
            ("axis_deg", aims.axis_deg),
            ("relation_mm", aims.relation_mm),
            ("minutes", aims.minutes),
            ("travel_m", aims.travel_m),
        )
        if value
    ]
    return ", ".join(found)


def _helps(pendant: Pendant, chosen: Exercise) -> str:
    allowed = [k for k in _HELPS if getattr(chosen.allowed, k)]
    missing = [k for k in _HELPS if k not in allowed]
    said = ", ".join(pendant.t(f"training.help_{k}") for k in allowed)
    if missing:
        said += ". " + pendant.t(
            "training.without", helps=", ".join(pendant.t(f"training.help_{k}") for k in missing)
        )
    return said


def running(pendant: Pendant, now: Running) -> str:
    """The task, and how far it is done."""
    t, state = pendant.t, pendant.session.state
    chosen = exercise(now.begun.exercise)
    words = chosen.said(pendant.language)
    seconds = max(0, int(time.time() - now.begun.at))
    rows = [(t("training.clock"), f"{seconds // 60}:{seconds % 60:02d} / {chosen.aims.minutes:g}:00")]
    if now.wizard is not None:
        rows.append((t("training.steps"), f"{now.wizard.index} / {len(now.wizard.steps)}"))
    else:
        done = len(state.steps) - len(state.missing)
        rows.append((t("training.points"), f"{done} / {len(state.steps)}"))
        if chosen.goal == "tool":
            taught = state.tool.name if state.tool is not None else "-"
            rows.append((t("training.active"), taught))
    hint = t(f"training.where_{chosen.goal}")
    return (
        html.instruction(words.title, words.task)
        + html.table(rows, testid="exercise-progress", widths=("50%", "50%"))
        + html.paragraph(hint, faint=True, testid="exercise-where")
    )


def after(pendant: Pendant, card: ScoreCard) -> str:
    """The score card."""
    t = pendant.t
    colour = "green" if card.total >= 80 else "yellow" if card.total >= 50 else "red"
    minutes, seconds = divmod(round(card.seconds), 60)
    out = html.light(
        colour,
        t("training.total", total=f"{card.total:.0f}", time=f"{minutes}:{seconds:02d}"),
        testid="score-total",
    )
    out += "".join(_bar(pendant, part.key, part.value, part.weight) for part in card.parts)
    rows = [
        (t(f"training.figure_{name}"), f"{card.figures[name]:.{digits}f}")
        for name, digits in _FIGURES
        if name in card.figures
    ]
    out += html.table(rows, testid="score-figures", widths=("76%", "24%"))
    if card.right_answer:
        right = _said(pendant, card.right_answer, card.right_number)
        said = _said(pendant, card.answer, card.number) if card.answer else "-"
        out += html.table(
            [(t("training.you_said"), said), (t("training.it_was"), right)],
            testid="score-answer",
            widths=("30%", "70%"),
        )
    if card.truth:
        numbers = ", ".join(f"{value:.2f}" for value in card.truth.values())
        key = "training.truth_tool" if "tool_x_mm" in card.truth else "training.truth_base"
        out += html.paragraph(t(key, numbers=numbers), testid="score-truth")
    notes = [
        ("green" if a.code == "well" else "blue", t(f"training.advice_{a.code}", **a.fields))
        for a in card.advice
    ]
    return out + html.notes(notes, testid="score-advice")


def _said(pendant: Pendant, answer: str, number: int) -> str:
    words = pendant.t(f"training.answer_{answer}")
    return f"{words} ({number})" if number else words


def _bar(pendant: Pendant, key: str, value: float, weight: float) -> str:
    colour = html.COLOURS["green" if value >= _GOOD else "yellow" if value >= _FAIR else "red"]
    label, width = html.escape(pendant.t(f"training.part_{key}")), round(_FULL_BAR * value)
    bar = (
        f'<span style="display:inline-block;width:{_FULL_BAR}px;height:9px;background:rgba(128,128,128,.2)">'
        f'<span style="display:block;width:{width}px;height:9px;background:{colour}"></span></span>'
    )
    points = f'<span style="width:64px;text-align:right">{value * weight:.0f} / {weight:.0f}</span>'
    return html.block(
        '<span style="display:flex;align-items:center;gap:8px">'
        f'<span style="flex:1">{label}</span>{bar}{points}</span>',
        testid=f"score-{key}",
        style="padding:1px 10px",
    )
