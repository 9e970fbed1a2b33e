"""What to do better next: codes with their figures, put into words where they are read."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import msgspec
import numpy as np

from app.calibration.captures import of_role
from app.geometry import angle_between
from app.session import SessionState
from app.session.actions import Finish
from app.training.exercise import Exercise
from app.units import deg, mm

_MOST = 4  # pieces of advice at once: more are not read
_WELL = 0.999  # share of a part from which on there is nothing to say
_TILT = 40.0  # degrees two touches should at least be apart
_SAME = 8.0  # degrees: closer than this an orientation of before was touched again
_STROKE = 100.0  # mm a stroke should at least be long
_DECEIVED = 2.0  # times: the true error beside what the residual makes one believe


class Advice(msgspec.Struct, frozen=True):
    """One piece of advice: key of its text, and the figures in it as they are shown."""

    code: str
    fields: dict[str, str] = {}


class _Scored(Protocol):
    @property
    def key(self) -> str: ...
    @property
    def value(self) -> float: ...


def advice_for(
    exercise: Exercise,
    figures: dict[str, float],
    parts: Sequence[_Scored],
    state: SessionState,
    finish: Finish,
    right: str,
    number: int,
) -> tuple[Advice, ...]:
    """The most useful things to do better, the first the most useful; what went well is said where all did."""
    lacking = {part.key: part.value for part in parts if part.value < _WELL}
    found: list[Advice] = []
    if "answer" in lacking:
        found.append(_answer(finish, right, number))
    if "accuracy" in lacking:
        found += _accuracy(exercise, figures, state)
    if "axes" in lacking and "axis_deg" in figures:
        found.append(_axes(state))
    if "care" in lacking and figures["near_misses"]:
        found.append(
            Advice("care", {"times": f"{figures['near_misses']:.0f}", "mm": f"{figures['closest_mm']:.0f}"})
        )
    if "time" in lacking and figures["seconds"] > 60.0 * exercise.aims.minutes:
        found.append(Advice("time", {"minutes": f"{exercise.aims.minutes:g}"}))
    if "tidy" in lacking and figures["repeats"]:
        found.append(Advice("tidy", {"times": f"{figures['repeats']:.0f}"}))
    if "travel" in lacking and figures.get("travel_m", 0.0) > exercise.aims.travel_m:
        found.append(
            Advice("travel", {"m": f"{figures['travel_m']:.1f}", "aim": f"{exercise.aims.travel_m:g}"})
        )
    if not found and lacking == {"alone": lacking.get("alone")}:
        return (Advice("alone"),)
    return tuple(found[:_MOST]) or (Advice("well"),)


def _answer(finish: Finish, right: str, number: int) -> Advice:
    if finish.answer == right:
        return Advice("number", {"number": str(number)})
    return Advice(f"look_{right}")


def _accuracy(exercise: Exercise, figures: dict[str, float], state: SessionState) -> list[Advice]:
    if exercise.goal == "touch":
        if "touch_mm" not in figures:
            return [Advice("no_touches", {"touches": str(exercise.touches)})]
        return [Advice("touch", {"mm": f"{figures['touch_mm']:.2f}", "aim": f"{exercise.aims.touch_mm:g}"})]
    if exercise.goal == "relation":
        if "meeting_mm" not in figures:
            return [Advice("no_relation")]
        return [Advice("relation", {"mm": f"{figures['meeting_mm']:.2f}"})]
    if "tool_mm" not in figures:
        return [Advice("no_tool")]
    out = []
    residual = figures.get("residual_mm")
    if residual is not None and figures["tool_mm"] > _DECEIVED * residual:
        out.append(Advice("deceived", {"residual": f"{residual:.2f}", "error": f"{figures['tool_mm']:.2f}"}))
    turned = _least_turn(state, repeats=exercise.question is not None)
    if turned is not None and round(turned) < _TILT:
        out.append(Advice("tilt", {"deg": f"{turned:.0f}", "aim": f"{_TILT:.0f}"}))
    elif residual is not None and not out:
        out.append(Advice("careful"))
    return out


def _least_turn(state: SessionState, *, repeats: bool) -> float | None:
    """Degrees between the two touches that are most alike; None with fewer than two.

    Args:
        repeats: the task asks to touch an orientation of before again: pairs that are the same on purpose do not count.
    """
    touches = [c for c in state.ordered if "touch" in c.roles]
    if len(touches) < 2:
        return None
    rotations = np.array([c.T_base_flange.rotation for c in touches])
    angles = deg(angle_between(rotations[:, None], rotations[None, :]))
    pairs = angles[np.triu_indices(len(touches), 1)]
    if repeats:
        pairs = pairs[pairs > _SAME]
    return float(pairs.min()) if len(pairs) else None


def _axes(state: SessionState) -> Advice:
    origins = of_role(state.ordered, "origin")
    strokes = [c for c in state.ordered if c.role.removeprefix("-") in ("x", "y", "z")]
    if origins and strokes:
        start = origins[0].T_base_flange.position
        shortest = mm(min(float(np.linalg.norm(c.T_base_flange.position - start)) for c in strokes))
        if shortest < _STROKE:
            return Advice("stroke", {"mm": f"{shortest:.0f}", "aim": f"{_STROKE:.0f}"})
    return Advice("axes")
