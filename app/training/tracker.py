"""The two-robot cell of an exercise: its truth, what is drawn of it, and what happens to its tracker."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from app.calibration.base.relation import Relation
from app.calibration.base.wizard import BaseWizard
from app.errors import TeachframeError
from app.geometry import Pose
from app.simulation.tracker_cell import TrackerCell, make_cell
from app.simulation.tracker_procedure import senses
from app.training.exercise import exercise
from app.units import from_deg, from_mm

#: How far arms and tracker are drawn beside where they stand: 6 mm and 0.2 degrees.
_BESIDE, _TURNED = from_mm(6.0), from_deg(0.2)


@dataclass(frozen=True, eq=False)
class TrackerTruth:
    """The secret of one attempt.

    Args:
        cell: where everything really stands.
        drawn: where it is drawn.
        pushed: what happens to the tracker between the robots; None where nothing does.
    """

    cell: TrackerCell
    drawn: TrackerCell
    pushed: Pose | None


@lru_cache(maxsize=64)
def tracker_truth(key: str, seed: int) -> TrackerTruth:
    """The secret of an attempt; raises UnknownNameError."""
    chosen = exercise(key)
    rng = np.random.default_rng([seed, 0x7EAD])
    first, second = chosen.hidden.robots
    cell = make_cell(first, second, seed)
    arms = [replace(arm, T_world_base=_beside(arm.T_world_base, rng)) for arm in cell.arms]
    tracker = replace(cell.tracker, T_world_tracker=_beside(cell.tracker.T_world_tracker, rng))
    drawn = TrackerCell(
        (arms[0], arms[1]), tracker, cell.nests + from_mm(rng.uniform(-3.0, 3.0, cell.nests.shape))
    )
    hidden = chosen.hidden
    turn = from_deg(hidden.tracker_turned_deg) * rng.choice([-1.0, 1.0])
    shift = from_mm(hidden.tracker_pushed_mm) * _level(rng)
    moved = bool(hidden.tracker_pushed_mm or hidden.tracker_turned_deg)
    return TrackerTruth(cell, drawn, Pose.exp(np.array([*shift, 0.0, 0.0, turn])) if moved else None)


def relation_of(truth: TrackerTruth, wizard: BaseWizard) -> Relation | None:
    """What the procedure gives, where it was carried through."""
    if not wizard.done:
        return None
    try:
        _, relation = wizard.solve(tuple(arm.robot for arm in truth.cell.arms), senses(truth.cell))
    except TeachframeError:
        return None
    return relation if relation is not None and relation.T_base1_base2 is not None else None


def _beside(pose: Pose, rng: np.random.Generator) -> Pose:
    return pose @ Pose.exp(np.concatenate([_BESIDE * _signs(rng), _TURNED * _signs(rng)]))


def _signs(rng: np.random.Generator) -> np.ndarray:
    return rng.choice([-1.0, 1.0], 3) * rng.uniform(0.5, 1.0, 3)


def _level(rng: np.random.Generator) -> np.ndarray:
    angle = rng.uniform(0.0, 2.0 * np.pi)
    return np.array([np.cos(angle), np.sin(angle), 0.0])
