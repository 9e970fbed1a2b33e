"""What is said of an exercise: before it, while it runs, and after."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.classroom.progress import Lesson
from app.panel import markup as html
from app.screens._training import headline
from app.screens._training.lesson import verdict
from app.session import SessionState
from app.session.report import moment
from app.session.state import Running, accepted, robot_named
from app.training.exercise import Exercise, begun_exercise
from app.training.levels import level_of
from app.training.score import Part, ScoreCard

if TYPE_CHECKING:
    from app.screens.context import Context

_HELPS = ("distance", "closeup", "next_touch", "handle", "touch", "light")
#: Figures on the card, in their order, with the digits they are shown with.
_FIGURES = (
    ("tool_mm", 2), ("residual_mm", 2), ("known_mm", 2), ("axis_deg", 2), ("touch_mm", 2), ("meeting_mm", 2),
    ("promised_mm", 2), ("relation_mm", 2), ("relation_deg", 3), ("records", 0), ("repeats", 0), ("calculations", 0),
    ("travel_m", 1), ("near_misses", 0), ("closest_mm", 0),
)  # fmt: skip
_GOOD, _FAIR = 0.8, 0.5  # shares of a part from which its bar is green, yellow


def title(context: Context, chosen: Exercise, best: float | None, lesson: Lesson | None = None) -> str:
    """One line of the list: difficulty as stars, the best score so far; lessons that were given are marked."""
    given = f"{context.t('training.given')} · " if lesson is not None else ""
    stars = "★" * chosen.difficulty + "☆" * (5 - chosen.difficulty)
    reached = f"  ·  {best:.0f}" if best is not None else ""
    return f"{given}{stars}  {chosen.said(context.language).title}{reached}"


def before(context: Context, chosen: Exercise, lesson: Lesson | None = None) -> str:
    """What it is about, what helps, what is good, and until when it is to be done."""
    t, words = context.t, chosen.said(context.language)
    robots = chosen.hidden.robots or (chosen.robot,)
    names = " + ".join(robot_named(name).said("title", context.language) for name in robots)
    rows = [(t("training.robot"), names), (t("training.good"), _aims(context, chosen))]
    if chosen.goal != "relation":
        without = lesson.without if lesson is not None else ()
        rows.append((t("training.helps"), _helps(context, chosen, without)))
    if lesson is not None and lesson.due:
        rows.append((t("training.due"), moment(lesson.due, "%Y-%m-%d %H:%M")))
    return (
        html.instruction(words.title, words.task)
        + html.paragraph(words.learn, faint=True, testid="exercise-learn")
        + html.table(rows, testid="exercise-facts")
    )


def _aims(context: Context, chosen: Exercise) -> str:
    t, aims = context.t, chosen.aims
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
    return context.t("list.between").join(found)


def _helps(context: Context, chosen: Exercise, without: tuple[str, ...]) -> str:
    allowed = [k for k in _HELPS if getattr(chosen.allowed, k) and k not in without]
    missing = [k for k in _HELPS if k not in allowed]
    between = context.t("list.between")
    said = between.join(context.t(f"training.help_{k}") for k in allowed)
    if missing:
        said += context.t("list.sentences") + context.t(
            "training.without", helps=between.join(context.t(f"training.help_{k}") for k in missing)
        )
    return said


def running(context: Context, now: Running) -> str:
    """The task, and how far it is done."""
    t, state = context.t, context.session.state
    chosen = begun_exercise(now.begun)
    words = chosen.said(context.language)
    rows = [(t("training.clock"), headline.clock(now))]
    if now.wizard is not None:
        rows.append((t("training.steps"), f"{now.wizard.index} / {len(now.wizard.steps)}"))
    else:
        done = len(state.steps) - len(state.missing)
        rows.append((t("training.points"), f"{done} / {len(state.steps)}"))
        if chosen.goal == "tool":
            taught = state.tool.name if state.tool is not None else "-"
            rows.append((t("training.active"), taught))
    hint = t(f"training.where_{chosen.goal}")
    level = level_of(now.begun)
    hints = html.paragraph(words.learn, testid="exercise-hint") if level != "eye" else ""
    return (
        html.instruction(headline.title(context, now), words.task)
        + html.table(rows, testid="exercise-progress")
        + html.paragraph(hint, faint=True, testid="exercise-where")
        + (html.more(t("training.hint"), hints) if hints else "")
    )


def done(state: SessionState, now: Running) -> bool:
    """True where everything the task asks for is there, so that it is finished next."""
    goal = begun_exercise(now.begun).goal
    if goal == "relation":
        return now.wizard is not None and now.wizard.done
    return state.tool is not None if goal == "tool" else not state.missing


def finished_next(state: SessionState, now: Running) -> bool:
    """True where the key that finishes is the one pressed next.

    An exercise may begin with an active tool, and a second try may be under way beside an accepted one: with a tool
    asked for, it is the result that is accepted and still shown.
    """
    tool = begun_exercise(now.begun).goal == "tool"
    return done(state, now) and (not tool or accepted(state))


def after(context: Context, card: ScoreCard) -> str:
    """The score card."""
    t = context.t
    colour, passed = verdict(context, card)
    minutes, seconds = divmod(round(card.seconds), 60)
    out = html.light(
        colour,
        t("training.total", total=f"{card.total:.0f}", time=f"{minutes}:{seconds:02d}"),
        testid="score-total",
    )
    out += html.paragraph(passed, testid="score-passed", strong=True)
    out += html.joined(
        _bar(context, part, points) for part, points in zip(card.parts, card.shown, strict=True)
    )
    rows = [
        (t(f"training.figure_{name}"), f"{card.figures[name]:.{digits}f}")
        for name, digits in _FIGURES
        if name in card.figures
    ]
    out += html.table(rows, testid="score-figures")
    if card.right_answer:
        right = _said(context, card.right_answer, card.right_number)
        said = _said(context, card.answer, card.number) if card.answer else "-"
        out += html.table(
            [(t("training.you_said"), said), (t("training.it_was"), right)],
            testid="score-answer",
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


def _said(context: Context, answer: str, number: int) -> str:
    words = context.t(f"training.answer_{answer}")
    return f"{words} ({number})" if number else words


def _bar(context: Context, part: Part, points: int) -> str:
    colour = "green" if part.value >= _GOOD else "yellow" if part.value >= _FAIR else "red"
    words = f"{points} / {part.weight:.0f}"
    return html.bar(
        context.t(f"training.part_{part.key}"), part.value, colour, words, testid=f"score-{part.key}"
    )
