"""The spike moved or the tip bent between two touches, or one touch missed.

Compared with "nothing happened": the spike stands elsewhere from touch k on (3 numbers), the tip is bent from touch k
on (3), one touch missed (3). The best of them is reported where it is better than chance would make the best of that
many, by the F test with Bonferroni's correction: to be looked at where one good calibration in a hundred looks so, and
not to be accepted where one in a thousand does. One in a hundred is a red light every week where a class is taught.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import special

from app.calibration.captures import Capture, of_role, stack
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.wording import phrase, remark
from app.units import from_mm, mm

RARE = 0.01
#: Chance below which the result should not be accepted as it stands.
SURE = 0.001
#: Changes below this are not worth a word, however certain [m].
LEAST = from_mm(0.3)
_ROUNDING = 1e-7
#: A change whose share of its own columns is smaller looks like the tool or the spike itself.
_UNTOLD = 1e-9


@dataclass(frozen=True)
class _Story:
    kind: str
    touch: int  # counted from 0: the first touch that is different
    sse: float
    size: float


@dataclass(frozen=True)
class Bumped:
    key: str = "bumped"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        rotations, positions = stack(of_role(captures, "touch"))
        n = len(positions)
        if n < 4 or any("known" in c.roles for c in captures):
            return []
        base = np.concatenate([rotations, -np.broadcast_to(np.eye(3), (n, 3, 3))], axis=2)
        before = _sse(base, positions)[0]
        if before < 3 * n * _ROUNDING**2:
            return []
        stories = _stories(base, rotations, positions)
        best = min(stories, key=lambda story: story.sse)
        dof = 3 * n - 9
        ratio = (before - best.sse) / 3.0 / max(best.sse / dof, 1e-24)
        chance = float(special.fdtrc(3, dof, ratio)) * len(stories)
        if chance > RARE or best.size < LEAST:
            return []
        near = {s.kind for s in stories if s.touch == best.touch and s.sse < 2.0 * best.sse + _ROUNDING**2}
        return [self._say(best, near | {best.kind}, n, severe=chance < SURE)]

    def _say(self, best: _Story, kinds: set[str], n: int, *, severe: bool) -> Warning_:
        number, size = best.touch + 1, mm(best.size)
        if best.kind == "missed":
            return remark(self.key, "missed", severe=severe, touch=number, size=size)
        told = kinds - {"missed"}
        which = next(iter(told)) if len(told) == 1 else "either"
        last = "these" if number < n else "this"
        return remark(
            self.key,
            severe=severe,
            touch=number,
            before=number - 1,
            what=phrase(f"check.bumped_{which}", size=size),
            again=phrase(f"check.bumped_{last}", touch=number, last=n),
        )


CHECK = Bumped()


def _sse(matrix: np.ndarray, positions: np.ndarray) -> tuple[float, np.ndarray]:
    tall = matrix.reshape(-1, matrix.shape[2])
    solution = np.linalg.lstsq(tall, -positions.reshape(-1), rcond=1e-9)[0]
    residual = tall @ solution + positions.reshape(-1)
    return float(residual @ residual), solution


def _stories(base: np.ndarray, rotations: np.ndarray, positions: np.ndarray) -> list[_Story]:
    """Every change of three numbers that these touches could tell, in a time that grows with their number.

    Three more columns c beside the base's take e^T S^-1 e from the sum of squares, with

        e = sum c_i^T r_i        S = sum c_i^T c_i - B^T G^-1 B,   B = sum b_i^T c_i,   G = sum b_i^T b_i

    over the touches that the change reaches, r being what the base leaves over. Sums from touch k on are running sums.
    """
    n = len(positions)
    before, solution = _sse(base, positions)
    residual = -(np.einsum("nij,j->ni", base, solution) + positions)
    inverse = np.linalg.pinv(np.einsum("nij,nik->jk", base, base), rcond=1e-14, hermitian=True)
    eye = np.broadcast_to(np.eye(3), (n, 3, 3))
    later = np.arange(2, n - 1)  # two touches at least on either side: else it is one that missed
    found: list[_Story] = []
    for kind, blocks, places in (
        ("missed", eye, np.arange(n)),
        ("spike", eye, later),
        ("tip", rotations, later),
    ):
        e = np.einsum("nij,ni->nj", blocks, residual)
        B = np.einsum("nij,nik->njk", base, blocks)
        D = np.einsum("nij,nik->njk", blocks, blocks)
        if kind != "missed":
            e, B, D = (np.cumsum(part[::-1], axis=0)[::-1] for part in (e, B, D))
        e, B, D = e[places], B[places], D[places]
        values, vectors = np.linalg.eigh(D - np.swapaxes(B, 1, 2) @ inverse @ B)
        told = values > _UNTOLD * np.trace(D, axis1=1, axis2=2)[:, None]
        along = np.einsum("nji,nj->ni", vectors, e)
        change = np.where(told, along / np.where(told, values, 1.0), 0.0)
        sse = np.maximum(before - np.sum(along * change, axis=1), 0.0)
        size = np.linalg.norm(change, axis=1)
        found += [
            _Story(kind, k, left, moved)
            for k, left, moved in zip(places.tolist(), sse.tolist(), size.tolist(), strict=True)
        ]
    return found
