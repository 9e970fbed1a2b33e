"""The cell somebody works in while an exercise is done."""

from __future__ import annotations

from dataclasses import replace

from app.geometry import Pose
from app.session.actions import Begin
from app.session.state import Running, SessionState
from app.simulation.world import World
from app.training.exercise import Exercise, begun_exercise, lesson_of
from app.training.truth import Truth, truth_of


def begin(
    exercise: Exercise, seed: int, at: float, trainee: str = "", without: tuple[str, ...] = ()
) -> Begin:
    """The action that begins an attempt.

    Args:
        seed: draws the truth.
        at: when [s since 1970].
        trainee: who does it.
        without: helps its class does not allow.
    """
    tools: tuple[tuple[str, tuple[float, ...]], ...] = ()
    if exercise.goal != "relation":
        active = truth_of(exercise.key, seed).T_flange_tool_active
        if active is not None:
            tools = (("tool 1", tuple(float(v) for v in active.matrix.ravel())),)
    tracker = "" if exercise.goal != "relation" else "nests" if exercise.nests else "bare"
    return Begin(
        exercise.key,
        seed,
        at,
        exercise.robot,
        exercise.mode,
        exercise.touches,
        tools,
        tracker,
        trainee,
        lesson_of(exercise),
        without,
    )


def world_of(state: SessionState) -> World | None:
    """The cell of the exercise that is being done, as it is now; None where none is, or it is the two-robot cell."""
    if state.running is None or state.running.wizard is not None:
        return None
    begun = state.running.begun
    return world_now(truth_of(begun_exercise(begun).key, begun.seed), state)


def world_now(truth: Truth, state: SessionState) -> World:
    """The cell as it is before the next touch: what happens with a touch has happened once that many are recorded."""
    running = state.running
    world = at_touch(truth, _touch(running))
    active = state.tool.T_flange_tool if state.tool else None
    return world if active is None else replace(world, T_flange_tool_active=active)


def at_touch(truth: Truth, number: int) -> World:
    """The cell while touch `number`, from 1, is made."""
    world = replace(truth.world, row=number)
    if number < truth.spike_from or not truth.spike_shift.any():
        return world
    picture = world.picture and replace(
        world.picture, p_base_spike=world.picture.p_base_spike + truth.spike_shift
    )
    return replace(world, p_base_spike=world.p_base_spike + truth.spike_shift, picture=picture)


def true_tool(truth: Truth, number: int) -> Pose:
    """T_flange_tool as it is while touch `number` is made: a tip that was bent is bent."""
    world = at_touch(truth, number)
    slips = tuple(fault for fault in world.faults if fault.where.get("body") == "tool")
    seat = replace(world, faults=slips)
    q = world.robot.home
    return seat.shown_flange(q).inverse() @ seat.tip(q)


def _touch(running: Running | None) -> int:
    return 1 if running is None else running.records + 1
