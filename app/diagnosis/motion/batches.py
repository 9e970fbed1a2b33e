"""Candidates by the batch: Gram matrices bare and with the model projected off, and what each block of time says."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.motion.system import Group, System

if TYPE_CHECKING:
    from app.diagnosis.motion.scoring import Solution


@dataclass(frozen=True, eq=False)
class Batch:
    """Groups of one size, or windows of one group.

    Args:
        raw, matrix: (c, k, k) Gram matrices bare and projected.
        block: (c, k, B) projected block scores.
        windows: (c, 2) block edges, or None.
    """

    groups: list[Group]
    raw: np.ndarray
    matrix: np.ndarray
    block: np.ndarray
    windows: np.ndarray | None


def singles(
    system: System, solution: Solution, scores: list[np.ndarray], spread: np.ndarray, groups: list[Group]
) -> list[Batch]:
    """Groups as they are, those of one size together.

    Args:
        scores: per joint (B, P) columns^T residual, block by block.
        spread: (p, B) covariance of the model times its own scores.
    """
    alike: dict[tuple[bool, int], list[Group]] = {}
    for group in sorted(groups, key=lambda g: -1 if g.joint is None else g.joint):
        alike.setdefault((group.joint is None, group.size), []).append(group)
    found = []
    for (shared, size), members in alike.items():
        count, joints = len(members), np.array([-1 if g.joint is None else g.joint for g in members])
        raw, cross = np.zeros((count, size, size)), np.zeros((count, size, len(solution.theta)))
        block = np.zeros((count, size, spread.shape[1]))
        for j, part in enumerate(system.parts):
            here = slice(0, count) if shared else slice(*np.searchsorted(joints, [j, j + 1]).tolist())
            if here.start == here.stop:
                continue
            at = np.array([part.places[g].start for g in members[here]])[:, None] + np.arange(size)
            rows = part.total[at.reshape(-1)]
            raw[here] += part.total[at[:, :, None], at[:, None, :]]
            cross[here][:, :, solution.positions[j]] += rows[:, solution.columns[j]].reshape(*at.shape, -1)
            block[here] += np.moveaxis(scores[j][:, at], 0, -1)
        flat = cross.reshape(-1, len(solution.theta))
        matrix = raw - (flat @ solution.covariance).reshape(cross.shape) @ np.swapaxes(cross, 1, 2)
        found.append(Batch(members, raw, matrix, block - (flat @ spread).reshape(block.shape), None))
    return found


def windows_of(
    system: System, solution: Solution, spread: np.ndarray, group: Group, windows: np.ndarray, null: bool
) -> Batch:
    """All windows of one base group at once: sums over blocks are differences of running sums."""
    D, E, U = _per_block(system, solution, group)
    D = np.concatenate([np.zeros_like(D[:1]), np.cumsum(D, 0)])
    E = np.concatenate([np.zeros_like(E[:1]), np.cumsum(E, 0)])
    a, b = windows[:, 0], windows[:, 1]
    # A window is the difference of two running sums: products of those once, whatever the number of windows.
    flat = E.reshape(-1, E.shape[2])
    taken = (flat @ solution.covariance @ flat.T).reshape(*E.shape[:2], *E.shape[:2]).swapaxes(1, 2)
    raw = D[b] - D[a]
    matrix = raw - (taken[b, b] - taken[b, a] - taken[a, b] + taken[a, a])
    lost = (flat @ spread).reshape(*E.shape[:2], -1)
    if null:
        index = np.arange(len(U) + 1)
        inside = (index >= a[:, None]) & (index < b[:, None])  # (w, B + 1)
        block = inside[:, None, :] * np.concatenate([U, np.zeros_like(U[:1])]).T[None]
    else:
        running = np.concatenate([np.zeros_like(U[:1]), np.cumsum(U, 0)])
        block = (running[b] - running[a])[:, :, None]
    block = block - (lost[b] - lost[a])
    return Batch([group], raw, matrix, block, windows)


def _per_block(system: System, solution: Solution, group: Group):
    """Block by block: Gram matrix (B, k, k), its cross with the model (B, k, p), scores (B, k)."""
    blocks, p, k = system.block_count, len(solution.theta), group.size
    D, E, U = np.zeros((blocks, k, k)), np.zeros((blocks, k, p)), np.zeros((blocks, k))
    for j, (part, col, pos) in enumerate(
        zip(system.parts, solution.columns, solution.positions, strict=True)
    ):
        if group.joint is not None and group.joint != j:
            continue
        place = part.places[group]
        own, rest = part.activate(np.arange(place.start, place.stop)), part.activate(col)
        blocks = part.blocks[:, own]
        cross = blocks[:, :, rest]
        D += blocks[:, :, own]
        E[:, :, pos] += cross
        U += blocks[:, :, 0] - cross @ solution.theta[pos]
    return D, E, U
