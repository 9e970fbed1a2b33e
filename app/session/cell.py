"""The cell as the session says: where points from a file were touched, and what a saved model makes of its arm."""

from __future__ import annotations

from dataclasses import replace

from app.errors import TeachframeError
from app.session import SessionState
from app.session.solving import solve
from app.simulation.faults import faults_of
from app.simulation.world import World

_TABLE = 0.55  # height of the table, as a share of the spike's
_LOWEST = 0.05  # [m]: a spike lower than this stands on the floor


def cell_of(world: World, state: SessionState) -> World:
    """The practice cell with what the session holds of it."""
    if state.source is not None:
        world = with_touched_point(world, state)
    return world if state.cell_model is None else replace(world, faults=faults_of(state.cell_model))


def with_touched_point(world: World, state: SessionState) -> World:
    """The world with its spike where the loaded touches met; unchanged where they cannot say."""
    try:
        solved = solve(state) if not state.missing else None
    except TeachframeError:
        return world
    if solved is None or not len(solved.result.residual_vectors):
        return world
    touched = solved.result.p_base
    height = float(max(_TABLE * touched[2], 0.0)) if touched[2] > _LOWEST else 0.0
    return replace(world, p_base_spike=touched, table_height=height)
