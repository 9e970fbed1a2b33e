"""An exercise and the journal of an attempt -> a score. Pure: the same journal always scores the same."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np

from app.calibration.quality.region import ellipsoid
from app.geometry import Pose
from app.session.journal import Entry
from app.simulation.tracker_procedure import miss
from app.training.advice import Advice, advice_for
from app.training.attempt import Attempt, follow
from app.training.cell import at_touch, true_tool
from app.training.exercise import Exercise
from app.training.levels import PASS, alone, level_of, levels_of
from app.training.tracker import relation_of, tracker_truth
from app.training.travel import off, travel
from app.training.truth import Truth, draw
from app.units import deg, mm

#: What each part of a score weighs; parts an exercise has no aim for are left out and the rest is brought to 100.
WEIGHTS = {
    "accuracy": 50.0,
    "axes": 15.0,
    "answer": 30.0,
    "time": 10.0,
    "travel": 5.0,
    "care": 15.0,
    "alone": 30.0,
    "tidy": 5.0,
}
_NOTHING_LEFT = 4.0  # times the aim: from there on a part counts nothing
_A_NEAR_MISS = 0.25  # share of `care` that each costs
_A_REPEAT = 0.2  # share of `tidy` that each point recorded again costs
_WHOLE = 1e-6  # what a sum of decimals may miss a whole number by
_NUMBER = 0.3  # share of `answer` that the right touch or joint is worth


class Part(msgspec.Struct, frozen=True):
    """One part of a score: 0 to 1, and its weight, a whole number of points."""

    key: str
    value: float
    weight: float

    @property
    def points(self) -> float:
        """Of the total."""
        return self.value * self.weight


class ScoreCard(msgspec.Struct, frozen=True):
    """What came of one attempt. Lengths in mm and m, angles in degrees, as their names say.

    Args:
        exercise: its key.
        seed: what drew the truth.
        begun: when [s since 1970]; `seconds` is how long it took.
        total: 0 to 100.
        parts: what it is made of.
        figures: everything measured, by name; what could not be is not there.
        truth: what was hidden, by name.
        answer, number: what the trainee said is wrong; `right_answer`, `right_number` what was.
        given_up: nothing was scored.
        advice: what to do better next.
        level: how many helps there were; empty in scores of versions that had no levels.
    """

    exercise: str
    seed: int
    begun: float
    seconds: float
    total: float
    parts: tuple[Part, ...]
    figures: dict[str, float]
    truth: dict[str, float]
    answer: str
    number: int
    right_answer: str
    right_number: int
    given_up: bool = False
    advice: tuple[Advice, ...] = ()
    level: str = ""

    @property
    def passed(self) -> bool:
        """True where the pass mark was reached."""
        return not self.given_up and self.total >= PASS

    @property
    def shown(self) -> list[int]:
        """Whole points of each part: they add up to the whole points of the total."""
        return apportioned([part.points for part in self.parts], round(self.total))


def score(exercise: Exercise, entries: Sequence[Entry]) -> ScoreCard:
    """The score of one attempt.

    Args:
        exercise: which one it was.
        entries: the journal's actions with their times, from Begin to Finish.

    Raises:
        InputError: not a whole attempt.
    """
    seed = getattr(entries[0].action, "seed", 0) if entries else 0
    if exercise.goal == "relation":
        attempt = follow(entries, None)
        figures, hidden = _relation(exercise, attempt, seed)
        pushed = tracker_truth(exercise.key, seed).pushed is not None
        right, number = ("tracker_moved" if pushed else "nothing"), 0
    else:
        truth = draw(exercise, seed)
        attempt = follow(entries, truth)
        figures, hidden = _tool(exercise, attempt, truth)
        right, number = truth.answer, truth.number
    figures |= {
        "seconds": attempt.seconds,
        "records": attempt.records,
        "repeats": attempt.repeats,
        "calculations": attempt.calculations,
    }
    parts = _parts(exercise, attempt, figures, right, number)
    total = sum(part.points for part in parts)
    finish = attempt.finish
    return ScoreCard(
        exercise.key,
        seed,
        attempt.begin.at,
        round(attempt.seconds, 1),
        0.0 if finish.given_up else round(total, 1),
        parts,
        {name: round(float(value), 4) for name, value in figures.items()},
        {name: round(float(value), 4) for name, value in hidden.items()},
        finish.answer,
        finish.number,
        right if exercise.question else "",
        number,
        finish.given_up,
        () if finish.given_up else advice_for(exercise, figures, parts, attempt.state, finish, right, number),
        level_of(attempt.begin),
    )


def _tool(exercise: Exercise, attempt: Attempt, truth: Truth) -> tuple[dict[str, float], dict[str, float]]:
    state, figures = attempt.state, {}
    at_end = at_touch(truth, attempt.records + 1)
    tool = true_tool(truth, attempt.records + 1)
    way = travel(at_end, attempt.way)
    figures |= {"travel_m": way.length, "near_misses": way.near, "closest_mm": mm(way.closest)}
    if attempt.misses:
        figures["touch_mm"] = mm(float(np.mean(list(attempt.misses.values()))))
    result = state.result.result if state.result else None
    taught: Pose | None = state.tool.T_flange_tool if state.tool else None
    if taught is None and result is not None:
        taught = result.T_flange_tool
    if taught is not None:
        distance, angle = off(tool, taught)
        figures |= {"tool_mm": mm(distance)}
        if exercise.aims.axis_deg:
            figures["axis_deg"] = deg(angle)
    if result is not None:
        figures["residual_mm"] = mm(result.mean)
        if len(result.residual_vectors):
            figures["known_mm"] = mm(float(ellipsoid(result).semi_axes[0]))
    x, y, z = mm(tool.position)
    return figures, {"tool_x_mm": x, "tool_y_mm": y, "tool_z_mm": z}


def _relation(exercise: Exercise, attempt: Attempt, seed: int) -> tuple[dict[str, float], dict[str, float]]:
    truth = tracker_truth(exercise.key, seed)
    x, y, z = mm(truth.cell.T_base1_base2.position)
    hidden = {"base2_x_mm": x, "base2_y_mm": y, "base2_z_mm": z}
    relation = relation_of(truth, attempt.wizard) if attempt.wizard is not None else None
    if relation is None or relation.T_base1_base2 is None:
        return {}, hidden
    distance, angle = off(truth.cell.T_base1_base2, relation.T_base1_base2)
    return {
        "relation_mm": mm(distance),
        "relation_deg": deg(angle),
        "meeting_mm": mm(miss(truth.cell, relation)),
        "promised_mm": mm(relation.region_meeting),
    }, hidden


def _parts(
    exercise: Exercise, attempt: Attempt, figures: dict[str, float], right: str, number: int
) -> tuple[Part, ...]:
    aims, finish = exercise.aims, attempt.finish
    values: dict[str, float] = {}
    aim, name = {
        "touch": (aims.touch_mm, "touch_mm"),
        "tool": (aims.tool_mm, "tool_mm"),
        "relation": (aims.relation_mm, "meeting_mm"),
    }[exercise.goal]
    values["accuracy"] = _within(figures.get(name), aim)
    if exercise.goal == "touch":  # all the touches that were asked for
        values["accuracy"] *= min(1.0, len(attempt.misses) / exercise.touches)
    if aims.axis_deg:
        values["axes"] = _within(figures.get("axis_deg"), aims.axis_deg)
    if exercise.question is not None:
        named = finish.answer == right
        share = _NUMBER if number and exercise.question.number else 0.0  # else it could not be entered
        values["answer"] = named * (1.0 - share + share * (finish.number == number))
    values["time"] = _within(attempt.seconds, 60.0 * aims.minutes)
    if aims.travel_m:
        values["travel"] = _within(figures.get("travel_m"), aims.travel_m)
    if exercise.goal != "relation":
        values["care"] = max(0.0, 1.0 - _A_NEAR_MISS * figures.get("near_misses", 0.0))
        if exercise.question is None:  # where something may happen on the way, to record again may be right
            values["tidy"] = max(0.0, 1.0 - _A_REPEAT * attempt.repeats)
    if len(levels_of(exercise)) > 1:
        values["alone"] = alone(exercise, attempt.begin.without)
    done = values["accuracy"] > 0 or values.get("answer", 0.0) > 0
    if not done:  # being quick and careful about nothing is worth nothing
        values = {
            key: value if key in ("accuracy", "axes", "answer") else 0.0 for key, value in values.items()
        }
    whole = 100.0 / sum(WEIGHTS[key] for key in values)
    weights = apportioned([whole * WEIGHTS[key] for key in values], 100)
    return tuple(
        Part(key, round(value, 4), float(weight))
        for (key, value), weight in zip(values.items(), weights, strict=True)
    )


def apportioned(shares: Sequence[float], total: int) -> list[int]:
    """Whole numbers next to `shares` that add up to `total`: the largest remainders are rounded up (Hamilton).

    Args:
        shares: whose sum is within 1 of `total`.
    """
    whole = [int(np.floor(share + _WHOLE)) for share in shares]
    by_remainder = sorted(range(len(shares)), key=lambda i: whole[i] - shares[i])
    for i in by_remainder[: max(total - sum(whole), 0)]:
        whole[i] += 1
    return whole


def _within(value: float | None, aim: float) -> float:
    """1 up to the aim, then down to 0 at _NOTHING_LEFT times it; 0 where there is no value."""
    if value is None or not np.isfinite(value):
        return 0.0
    return float(np.clip(1.0 - (value / aim - 1.0) / (_NOTHING_LEFT - 1.0), 0.0, 1.0))
