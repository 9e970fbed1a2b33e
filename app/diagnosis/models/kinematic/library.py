"""Every effect at every place as groups of columns at one state of the fit."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.effects.effect import Effect, Level
from app.diagnosis.models.kinematic.state import State, columns_of, free_columns
from app.diagnosis.models.kinematic.terms import Term
from app.diagnosis.regression.design import Absorbed, Design
from app.diagnosis.regression.evidence import Group
from app.diagnosis.selection.change_points import Kind, Scanner
from app.diagnosis.thresholds.evidence import FAMILY, STEP
from app.diagnosis.thresholds.naming import SEEN

if TYPE_CHECKING:
    from app.diagnosis.models.kinematic.candidates import Candidate, Library
    from app.diagnosis.models.kinematic.sensitivity import Sensitivity


#: rad, m: columns are made anew once the arm as fitted has moved by more. Levers are about a metre, so columns are then
#: off by a thousandth, and a step along them misses its end by a thousandth of itself; the next one starts there.
_ALIKE = 1e-3


@dataclass(eq=False)
class Linear:
    """The problem linearised at a state.

    Args:
        state: where.
        born: state at which the columns were worked out: this one, or one so near that they hardly differ.
        library: the candidates; candidate i has columns `columns[i]` (empty where it is not seen).
        design: columns scaled to nominal sizes; the response is such that weights are values, not steps.
        sensitivity: elementary columns, at `born`.
        free, absorbed: the set-up's columns.
        built: number of a candidate -> its columns in the design, seen or not, whether offered here or not.
        columns: the same for those that are offered here and seen.
        visible: share of each candidate's signature that the set-up cannot imitate.
    """

    state: State
    born: State
    library: Library
    design: Design
    sensitivity: Sensitivity
    free: np.ndarray
    absorbed: Absorbed | None
    built: dict[int, np.ndarray]
    columns: dict[int, np.ndarray]
    visible: dict[int, float]
    groups: list[Group] = field(default_factory=list)
    members: dict[int, tuple[int, ...]] = field(default_factory=dict)
    _scanner: Scanner | None = None
    _offers: dict[tuple[int, ...], tuple[list[Group], dict[int, tuple[int, ...]]]] = field(
        default_factory=dict
    )

    def raw(self, candidate: Candidate) -> np.ndarray:
        """(N, d) whitened columns of a candidate, scaled to nominal sizes, nothing projected off."""
        return self._block(candidate) * (candidate.widths * self.design.unit)

    def _block(self, candidate: Candidate) -> np.ndarray:
        """(N, d) the same per unit of each parameter, as whitened where the columns were worked out."""
        block = candidate.effect.columns(self.sensitivity, candidate.place)
        return block.reshape(self.born.weights.size, -1)

    def build(self, numbers: list[int]) -> None:
        """Puts the columns of candidates that are not there yet into the design."""
        new = [i for i in numbers if i not in self.built]
        if not new:
            return
        sizes = [len(self.library.fixed[i].widths) for i in new]
        ends = np.cumsum([0, *sizes]).tolist()
        every = self.design.room(ends[-1], sum(len(c.widths) for c in self.library.fixed) - ends[-1])
        for i, a, b in zip(new, ends, ends[1:], strict=False):
            np.multiply(self._block(self.library.fixed[i]), self.library.fixed[i].widths, out=every[:, a:b])
        numbers_of = self.design.fill(ends[-1])
        length = self.design.length[numbers_of]
        left = np.diagonal(self.design.matrix)[numbers_of] / self.design.unit**2
        seen = left > SEEN**2 * np.maximum(length, 1e-300)
        for i, a, b in zip(new, ends, ends[1:], strict=False):
            total = float(length[a:b].sum())
            self.visible[i] = float(np.sqrt(max(left[a:b].sum(), 0.0) / total)) if total > 0 else 0.0
            self.built[i] = numbers_of[a:b] if seen[a:b].any() else numbers_of[:0]

    def add(self, number: int) -> int:
        """Builds a candidate's columns and its group; returns the group's number."""
        self.build([number])
        self.columns[number] = self.built[number]
        return self.offer(number)

    def offer(self, number: int) -> int:
        """A group of its own for a candidate whose columns are built; returns the group's number."""
        self.groups.append(self._group(number))
        self.members[len(self.groups) - 1] = (number,)
        return len(self.groups) - 1

    def _group(self, number: int) -> Group:
        candidate = self.library.fixed[number]
        penalty = candidate.effect.penalty
        if candidate.place.scan:  # the choice of its row costs more than any law
            penalty = STEP + np.log(len(self.state.residual))
        return Group(  # its turn is behind all families: what was in makes room for it first
            self.columns[number], penalty + candidate.place.cost, candidate.effect.cap, label=number,
            positive=candidate.positive, turn=Level.CALIBRATION - 1,
        )  # fmt: skip

    @property
    def scanner(self) -> Scanner:
        """What may change at a row."""
        if self._scanner is None:
            shape = self.state.weights.shape
            kinds = [
                Kind(self.raw(c).reshape(*shape, -1), c.effect.cap, index)
                for index, c in enumerate(self.library.scanned)
            ]
            self._scanner = Scanner(self.design, kinds)
        return self._scanner

    def restated(self, state: State, unit: float, numbers: list[int]) -> Linear:
        """The same columns at a state nearby, whose weights are `unit` times those here."""
        response = state.white + self._explained(state.terms, numbers) * unit
        design = self.design.restated(response, self.design.unit * unit)
        scanner = None if self._scanner is None else self._scanner.restated(design)
        return replace(
            self, state=state, design=design, free=self.free * unit, columns={}, groups=[], members={},
            built=dict(self.built), visible=dict(self.visible), _scanner=scanner,
        )  # fmt: skip

    def _explained(self, terms: tuple[Term, ...], numbers: list[int]) -> np.ndarray:
        """(N,) what fitted terms with columns here explain, nothing projected off."""
        out = np.zeros(self.state.weights.size)
        inside = set(numbers)
        for term in terms:
            number = self.library.labels.get(term.label)
            if number in inside:
                candidate = self.library.fixed[number]
                out += self.raw(candidate) @ (term.values / candidate.widths)
        return out


def linearised(
    state: State, library: Library, levels: tuple[Level, ...], needed: set[int], last: Linear | None = None
) -> Linear:
    """Columns of all candidates of these levels (and of those needed) at a state.

    Args:
        needed: numbers of candidates that are built in any case.
        last: an earlier linearisation, whose columns serve again where they hardly differ.
    """
    numbers = [
        i for i, c in enumerate(library.fixed)
        if i in needed or (c.effect.level in levels and not c.place.scan)
    ]  # fmt: skip
    unit = None if last is None else likeness(last, state)
    if last is not None and unit is not None:
        here = last.restated(state, unit, numbers)
    else:
        here = _afresh(state, library, numbers)
    here.build(numbers)
    here.columns = {i: here.built[i] for i in numbers}
    _grouped(here, numbers)
    return here


def _afresh(state: State, library: Library, numbers: list[int]) -> Linear:
    """A linearisation at a state without any columns yet."""
    sensitivity = columns_of(state)
    free, absorbed = free_columns(state, sensitivity)
    used = round(float(np.count_nonzero(state.weights, axis=0) @ state.recording.worth))
    design = Design(np.zeros(state.weights.size), free, used, absorbed)
    here = Linear(state, state, library, design, sensitivity, free, absorbed, {}, {}, {})
    here.design = design.restated(state.white + here._explained(state.terms, numbers), 1.0)
    return here


def likeness(last: Linear, state: State) -> float | None:
    """How many times larger the weights of a state are than those of an earlier linearisation whose columns still hold.

    None where they do not: rows are weighed differently, or the arm moved so far that columns change by more than
    `_ALIKE` of themselves.
    """
    there, born = last.state.weights, last.born
    if there.shape != state.weights.shape:
        return None
    unit = float(state.weights.sum() / there.sum())
    if not np.allclose(state.weights, unit * there, rtol=1e-9, atol=0.0):
        return None
    moved = max(
        float(np.abs(a - b).max(initial=0.0))
        for a, b in (
            (state.cell.q, born.cell.q),
            (state.posed.points, born.posed.points),
            (state.posed.hand, born.posed.hand),
            (state.setup.rotations, born.setup.rotations),
        )
    )
    return unit if moved < _ALIKE else None


def _grouped(here: Linear, numbers: list[int]) -> None:
    """A group for every candidate that is seen, and one for every family; of the same columns they are the same."""
    key = tuple(numbers)
    if key not in here._offers:
        _put_into_groups(here, numbers)
        here._offers[key] = list(here.groups), dict(here.members)
    here.groups, here.members = list(here._offers[key][0]), dict(here._offers[key][1])


def _put_into_groups(here: Linear, numbers: list[int]) -> None:
    wholes: dict[str, list[int]] = {}
    for i in numbers:
        candidate = here.library.fixed[i]
        if not len(here.columns[i]):
            continue
        here.offer(i)
        if candidate.effect.whole and candidate.place.member:
            wholes.setdefault(_group_of(candidate.effect), []).append(i)
    effects = {group: here.library.fixed[inside[0]].effect for group, inside in wholes.items()}
    # one member that is seen of many says nothing of the others; one of one is all there is
    every = [_group_of(c.effect) for c in here.library.fixed if c.effect.whole and c.place.member]
    effects = {g: e for g, e in effects.items() if len(wholes[g]) > 1 or (e.always and every.count(g) == 1)}
    for group, effect in effects.items():
        inside = wholes[group]
        columns = np.unique(np.concatenate([here.columns[i] for i in inside]))
        # one decision a family, however many widths it has
        penalty = FAMILY / sum(other.family == effect.family for other in effects.values())
        here.groups.append(Group(columns, penalty, effect.cap, label=group, turn=int(effect.level)))
        here.members[len(here.groups) - 1] = tuple(inside)


def _group_of(effect: Effect) -> str:
    """Name of those that share one width."""
    return effect.group or effect.key


def terms_from(library: Library, values: dict[int, np.ndarray]) -> tuple[Term, ...]:
    """Terms from weights in nominal sizes, by number of the candidate."""
    return tuple(
        Term(library.fixed[i].effect, library.fixed[i].place, w * library.fixed[i].widths)
        for i, w in values.items()
    )
