"""Does structure remain, and what does it follow? Everything smooth, without names, against chance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.result import Leftover
from app.diagnosis.static.curves import JOINT_CURVE, shape_functions, smooth
from app.diagnosis.static.effect import Place
from app.diagnosis.static.fit import Fitted
from app.diagnosis.static.library import Candidate, Library
from app.diagnosis.static.looking import with_ghosts
from app.diagnosis.static.score import basis, flips, score_library

#: Chance below which something is said to be left over.
LEVEL = 0.01
NULLS = 199


@dataclass(frozen=True)
class _Group:
    where: dict
    block: np.ndarray  # (m, k, d)


def leftover_of(fitted: Fitted, rng: np.random.Generator, nulls: int = NULLS) -> Leftover:
    """The smooth structure that chance explains least, and its family-wise p."""
    groups = _groups(fitted)
    k = fitted.weights.shape[1]
    sizes = [g.block.shape[2] for g in groups]
    starts = np.concatenate([[0], np.cumsum(sizes)]).astype(int)
    blocks = np.concatenate([g.block for g in groups], axis=2)
    blocks = np.concatenate([blocks, np.zeros((fitted.ghosts, *blocks.shape[1:]))])
    matrix = blocks.reshape(fitted.rows * k, -1)
    named = tuple(Candidate(JOINT_CURVE, Place(g.where)) for g in groups)
    base = basis(fitted.jacobian)
    rest = fitted.white - base.q @ (base.q.T @ fitted.white)
    dof = max(fitted.size - base.q.shape[1], 2)
    signs = flips(rng, with_ghosts(fitted.recording.pose, fitted.ghosts), nulls)
    scores = score_library(
        Library(named, matrix, starts, np.zeros(len(named), bool), ()),
        base,
        rest,
        fitted.rows,
        dof,
        signs,
        np.zeros(fitted.rows),
    )
    best = int(scores.order()[0])
    return Leftover(scores.p_value(best), dict(scores.candidates[best].place.where))


def _groups(fitted: Fitted) -> list[_Group]:
    columns, situation = fitted.columns, fitted.recording.situation
    out: list[_Group] = []

    def add(where: dict, block: np.ndarray, functions: np.ndarray) -> None:
        if functions.any():
            shaped = block[:, :, :, None] * functions[:, None, None, :]
            out.append(_Group(where, shaped.reshape(*block.shape[:2], -1)))

    time = smooth(situation.time, 4)
    for j in range(situation.joint_count):
        joint = columns.joint[:, :, j, None]
        place = {"joint": j + 1}
        add({**place, "driver": "own_angle"}, joint, shape_functions(situation, place, "own_angle"))
        add({**place, "driver": "gravity_torque"}, joint, shape_functions(situation, place, "gravity_torque"))
        approach = {**place, "driver": "approach"}
        add(approach, joint, shape_functions(situation, approach, "sign"))
        add({**place, "driver": "time"}, joint, time)
        q = situation.q[:, j]
        add({**place, "driver": "own_angle"}, columns.base[:, :, :3], np.column_stack([np.sin(q), np.cos(q)]))
        add({**place, "driver": "own_angle"}, columns.tool[:, :, :3], np.column_stack([np.sin(q), np.cos(q)]))
    add({"body": "base", "driver": "time"}, columns.base[:, :, :3], time)
    add({"body": "tool", "driver": "time"}, columns.tool[:, :, :3], time)
    return out
