"""Loads taken up and contacts: at which time of the log, and what any law not yet in the design would bring."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.dynamic.event_rows import at_exact_rows
from app.diagnosis.dynamic.event_sums import between, block_gains, by_rows, gains
from app.diagnosis.dynamic.event_white import WhitePart, sums_of, white_parts
from app.diagnosis.dynamic.pieces import PIECES, Pieces, beside, from_start, spells, windows
from app.diagnosis.dynamic.swelling import swelling
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.design import TorqueDesign
from app.diagnosis.models.dynamic.library import Candidate, group_of, laws
from app.diagnosis.models.dynamic.noise import SKIPPED
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.regression.evidence import Evidence, Posterior, Selection
from app.diagnosis.selection.search import Offer
from app.diagnosis.thresholds.events import EDGE, MARGIN, MOST, SHORTEST
from app.diagnosis.thresholds.friction import STRIBECK

if TYPE_CHECKING:
    from app.diagnosis.effects.dynamic._law import Law


STRIDE = 4  # rows between edges that are tried at once; single rows are tried around the best


class Events:
    """Scans a log for events beside a selection, and weighs single laws exactly."""

    def __init__(self, design: TorqueDesign, evidence: Evidence, state: State, without: frozenset[str]):
        self.design, self.evidence, self.state = design, evidence, state
        # what has one end has fewer places, and comes first
        self._every = sorted((law for law in laws().values() if law.ends), key=lambda law: len(law.ends))
        self.laws = {
            law.key: law for law in self._every if law.key not in without and state.joints >= law.least_joints
        }
        ends = np.cumsum([0, *(len(law.linear) for law in self._every)]).tolist()
        self._own = {k.key: slice(a, b) for k, a, b in zip(self._every, ends, ends[1:], strict=False)}
        self._posterior: tuple[Selection, Posterior] | None = None
        self._throughout: dict[str, dict[int, np.ndarray]] = {}
        self.forget()

    def forget(self) -> None:
        """The noise changed."""
        self._columns: list[np.ndarray] | None = None
        self._pieces: list[Pieces] | None = None
        self._cached: tuple[Selection, tuple] | None = None
        self._posterior = None
        self._unsure: set[tuple] = set()  # what was looked at and is none

    # -------------------------------------------------------------- what a law would bring

    def _found(self, selection: Selection) -> Posterior:
        """The posterior of a selection, kept for the same one."""
        if self._posterior is None or self._posterior[0] != selection:
            self._posterior = (dict(selection), self.evidence.posterior(selection))
        return self._posterior[1]

    def beside(self, selection: Selection):
        """Inverse of the selection's M, its columns joint by joint and the residual, kept for the same selection."""
        if self._cached is not None and self._cached[0] == selection:
            return self._cached[1]
        found = self._found(selection)
        at = {int(c): i for i, c in enumerate(found.columns)}
        parts, residual = [], []
        for ids, white, own in zip(self.design.at, self.design.white, self.design.white_y, strict=True):
            here = [k for k, c in enumerate(ids.tolist()) if c in at]
            places = np.array([at[int(ids[k])] for k in here], int)
            columns = white[:, here]
            parts.append((columns, places))
            residual.append(own - columns @ found.weights[places])
        out = (found.covariance, parts, residual)
        self._cached = (dict(selection), out)
        return out

    def gain(self, selection: Selection, law: Law, place: Place, *, surely: bool = False) -> float:
        """Evidence that a law at a place would add [nats], its penalty counted.

        Args:
            surely: by what friction cannot hide alone, joints while they move, and by no more than it would be if the
                noise during the event were whatever the event leaves there: a loud stretch is no event.
        """
        inverse, parts, residual = self.beside(selection)
        counts = None  # rows of each joint that speak for it, where not all do
        if surely and law.hidden:
            counts = np.abs(self.state.qd) >= STRIBECK[-1] * self.state.speed
        found = sums_of(self.white_parts(law, place), parts, residual, len(inverse), counts)
        block = found.gram - found.cross @ inverse @ found.cross.T + np.eye(len(found.right))
        fit = 0.5 * float(found.right @ np.linalg.solve(block, found.right))
        if surely and 2.0 * fit < found.squares:
            fit = min(fit, -0.5 * found.rows * float(np.log1p(-2.0 * fit / found.squares)))
        return fit - 0.5 * float(np.linalg.slogdet(block)[1]) - law.penalty - place.cost

    def white_parts(self, law: Law, place: Place) -> dict[int, WhitePart]:
        """Whitened columns of a law at a place, joint by joint, where they are not nothing."""
        if law.windowed:
            return self.shaped(law, law.shape(self.state, place))
        columns, widths = law.block(self.state, place)
        return white_parts({j: c * widths for j, c in columns.items()}, self.design)

    def shaped(self, law: Law, shape: np.ndarray) -> dict[int, WhitePart]:
        """The same of an event that there is so much of, (M,), at each time."""
        inside = np.flatnonzero(shape)
        if not len(inside):
            return {}
        begin, end = int(inside[0]), int(inside[-1]) + 1
        part = {j: c[begin:end] * shape[begin:end, None] for j, c in self._lasting(law).items()}
        return white_parts(part, self.design, begin)

    def _lasting(self, law: Law) -> dict[int, np.ndarray]:
        """Columns of an event as if it lasted all the time, in nominal widths."""
        if law.key not in self._throughout:
            columns, widths = law.block(self.state, Place({"body": "tool"}))
            self._throughout[law.key] = {j: c * widths for j, c in columns.items()}
        return self._throughout[law.key]

    # -------------------------------------------------------------- events

    def offers(self, selection: Selection) -> Iterable[Offer]:
        """The best change of load and the best contact, their times refined."""
        present = [self.evidence.groups[g] for g in selection]
        if (
            sum(_is_event(g.label) for g in present) >= MOST
            or len(self.state.t) < 4 * PIECES
            or not self.laws
        ):
            return
        scanned = self._scan(selection)
        best = max((gain for _, _, gain in scanned), default=0.0)
        for key, where, gain in scanned:
            if gain < max(MARGIN, 0.3 * best):
                continue
            law, seat, cost = self.laws[key], (key, *where.values()), float(np.log(PIECES) * len(where))
            if seat in self._unsure:
                continue
            place, _ = self._refined(selection, law, where, cost)
            apart = self._apart(
                selection, law, place.where["from_s"], place.where.get("to_s", self.state.t[-1])
            )
            if not apart or self.gain(selection, law, place, surely=True) < MARGIN:
                self._unsure.add(seat)
                continue
            yield Offer(gain - MARGIN, 1.0, lambda law=law, place=place: self._take(law, place))

    def _take(self, law: Law, place: Place) -> int:
        own = self.design.add([law.block(self.state, place)])[0]
        self.evidence.groups.append(group_of(Candidate(law, place), own))
        return len(self.evidence.groups) - 1

    def _scan(self, selection: Selection) -> list[tuple[str, dict[str, float], float]]:
        """Best edges among the ends of pieces: all changes and all windows by sums over pieces."""
        found = self._found(selection)
        if self._pieces is None:
            white = self._whitened()
            self._pieces = [Pieces(z, y, PIECES) for z, y in zip(white, self.design.white_y, strict=True)]
        inverse, edges, rows = found.covariance, self._pieces[0].edges, int(self._pieces[0].edges[-1])
        gram, cross, right = beside(self._pieces, self.design, found)
        out = []
        t = self.state.t[SKIPPED:]
        at = t[np.minimum(edges, rows - 1)]
        share = self._moved
        first = np.flatnonzero((share[edges] >= EDGE) & (share[edges] <= 1.0 - EDGE))
        for key, law in self.laws.items():
            if len(law.ends) == 1:
                begin, last = spells(first, share[edges], over=bool(law.until))
                price = float(np.log(max(len(first), 1)))
            else:
                begin, last = windows()
                price = float(np.log(PIECES))
            apart = self._apart(selection, law, at[begin], at[last])
            begin, last = begin[apart], last[apart]
            choices = np.where((last < PIECES) | (len(law.ends) > 1), 2.0, 1.0) * price
            if not len(begin):
                continue
            gain = gains(gram, cross, right, inverse, begin, last, self._own[key]) - choices
            best = int(gain.argmax())
            ends = law.ends if last[best] == PIECES or not law.until else (*law.ends, law.until)
            where = dict(zip(ends, (float(at[begin[best]]), float(at[last[best]])), strict=False))
            out.append((key, where, float(gain[best] - 2.0)))
        return out

    def _apart(
        self, selection: Selection, law: Law, since: np.ndarray | float, until: np.ndarray | float
    ) -> np.ndarray:
        """False near an event of this kind in a selection: what else pushes then is its shape, and none of its own.

        Of changes of load those with both times alike; they may follow each other, and stand in each other.
        """
        end = float(self.state.t[-1])
        near = 2.0 * (end - float(self.state.t[0])) / PIECES
        labels = [self.evidence.groups[g].label for g in selection]
        there = [c.place.where for c in labels if isinstance(c, Candidate) and c.law is law]
        times = [(where["from_s"], where.get("to_s", end)) for where in there]
        out = np.ones(np.shape(since), bool)
        for a, b in times:
            if len(law.ends) == 1:
                out &= (np.abs(since - a) >= near) | (np.abs(until - b) >= near)
            else:
                out &= (until + near <= a) | (since - near >= b)
        return out

    @cached_property
    def _moved(self) -> np.ndarray:
        """(rows + 1,) share of the log's motion before each row: a load at rest is one with what friction holds."""
        goes = ~np.all([self.state.stands(j) for j in range(self.state.joints)], axis=0)[SKIPPED:]
        if not goes.any():
            goes[:] = True
        return np.concatenate([[0.0], np.cumsum(goes) / goes.sum()])

    def _whitened(self) -> list[np.ndarray]:
        """Columns of a load and of a force, in nominal widths, whitened, of the whole log."""
        if self._columns is None:
            everything = [self._lasting(law) for law in self._every]
            self._columns = [
                self.design.whiteners[j](np.hstack([part[j] for part in everything])) * self.design.alive[j]
                for j in range(self.design.joints)
            ]
        return self._columns

    @staticmethod
    def _at(where: dict[str, float], cost: float = 0.0) -> Place:
        return Place({"body": "tool", "driver": "time", **where}, cost=cost)

    def moved(self, selection: Selection, law: Law, place: Place) -> tuple[Place, float]:
        """An event with its edges where they bring most beside a selection, and how much that is [nats]."""
        where = {k: float(place.where[k]) for k in (*law.ends, law.until) if k in place.where}
        return self._refined(selection, law, where, place.cost)

    def _refined(
        self, selection: Selection, law: Law, where: dict[str, float], cost: float
    ) -> tuple[Place, float]:
        """Each edge in turn at the most evidence, then at single rows; a contact may also swell and fade."""
        inverse, parts, residual = self.beside(selection)
        held, once = len(law.ends) == 1, len(where) == 1
        white = [z[:, self._own[law.key]] for z in self._whitened()]
        rows = len(residual[0])
        t = self.state.t[SKIPPED:]
        edges = [int(np.searchsorted(t, time)) for time in where.values()]
        share = self._moved
        if once:
            edges.append(rows)
        reach, least = 2 * rows // PIECES, max(int(SHORTEST / max(float(np.median(np.diff(t))), 1e-9)), 2)
        least = int(EDGE * rows) if held else least
        for k in (0,) if once else (0, 1, 0, 1):
            low = max(0 if k == 0 else edges[0] + least, edges[k] - reach)
            high = max(min(edges[1] - least if k == 0 else rows, edges[k] + reach), low)
            if held:
                inside = np.flatnonzero((share >= EDGE) & (share <= 1.0 - EDGE))
                low, high = max(low, int(inside[0])), max(min(high, int(inside[-1])), int(inside[0]))
            if high <= low:  # the log leaves this edge no other place
                continue
            # Sums over the part that every trial has, and every few rows over what it may have more.
            fixed = slice(high, edges[1]) if k == 0 else slice(edges[0], low)
            sums = between(white, parts, residual, len(inverse), fixed)
            single = by_rows(white, parts, residual, len(inverse), slice(low, high), STRIDE)
            more = [from_start(v) for v in single]
            if k == 0:  # a later first edge leaves rows out
                more = [v[-1] - v for v in more]
            gram, cross, right = (s + m for s, m in zip(sums, more, strict=True))
            gain = block_gains(gram, cross, right, inverse)
            edges[k] = min(low + STRIDE * int(gain.argmax()), high)
        step = float(np.median(np.diff(t)))
        times = [float(t[min(k, rows - 1)]) - (0.5 * step if k < rows else -step) for k in edges]
        place = self._at(dict(zip(where, times, strict=False)), cost)
        best = at_exact_rows(self, selection, law, place, step)
        if law.swells:
            best = max(best, swelling(self, selection, law, place), key=lambda found: found[0])
        return best[1], best[0]


def _is_event(found: object) -> bool:
    return isinstance(found, Candidate) and found.law.windowed
