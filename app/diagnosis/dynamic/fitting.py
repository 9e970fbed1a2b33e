"""One log from its reading to a solved selection: what is undone in the log is undone, and looked at again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from app.diagnosis.dynamic.conventions import Reading
from app.diagnosis.dynamic.crossed import by_prediction
from app.diagnosis.dynamic.families import completed, plainer
from app.diagnosis.dynamic.shapes import Tangent, add_tangents
from app.diagnosis.dynamic.solution import Solution, solve
from app.diagnosis.dynamic.study import Study
from app.diagnosis.effects.dynamic._law import Law
from app.diagnosis.model import ModelEffect
from app.diagnosis.models.dynamic.hypothesis import Hypothesis
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.models.dynamic.samples import Samples, Taker
from app.diagnosis.models.dynamic.saved import beside
from app.diagnosis.models.dynamic.smoothing import Motion
from app.diagnosis.observations.joint_log import Log
from app.diagnosis.result import Progress
from app.kinematics import RobotModel

ROUNDS = 3
SETTLING = 5  # repetitions of undoing what remains of a delay, a factor, a mounting
#: Shares of a diagnosis: the search begins, has selected, has its values; and the part of what is left of the search
#: that a round takes.
_BEGUN, _SELECTED, _SOLVED, _ROUND = 0.15, 0.6, 0.75, 0.4
#: In nominal widths: what remains of an undone effect is nothing then.
SETTLED = 0.003


@dataclass(frozen=True, eq=False)
class Fitted:
    """A log with its laws.

    Args:
        take: gives the log's windows under any hypothesis.
        asked: with the whole library, as the selection was made.
        study: the selection alone, on windows in which everything undone is undone.
        solution: its values, what is undone held where it is.
        loose: the same with what is undone free, for its uncertainty.
        given: effects taken for part of the description.
        prior: what another log taught, or None.
        bends: groups in `loose` that stand for shape values of laws.
    """

    log: Log
    robot: RobotModel
    motion: Motion
    reading: Reading
    take: Taker
    asked: Study
    study: Study
    solution: Solution
    loose: Solution
    given: tuple[ModelEffect, ...]
    prior: Any = None
    bends: Mapping[int, Tangent] = field(default_factory=dict)

    @property
    def error(self) -> float:
        """Held-out root mean square [Nm], as recorded."""
        return _heldout(self.study, self.solution)

    @property
    def left(self) -> np.ndarray:
        """(n,) True where structure is left on a joint."""
        return self.study.left


def fit(
    log: Log,
    robot: RobotModel,
    motion: Motion,
    reading: Reading,
    tell: Progress,
    *,
    without: frozenset[str],
    stretch: Mapping[str, float],
    first: tuple[str, ...] = (),
    single: frozenset[str] = frozenset(),
    given: Sequence[ModelEffect] = (),
    prior: Law | None = None,
) -> Fitted:
    """Selects and solves, until what is undone (mounting, delay, factors) stands still.

    Args:
        without: laws that are not asked.
        stretch: key of a law -> how far its values may be off, over their nominal widths.
        first: keys of laws that the search starts from too.
        single: keys of laws that are asked at one place at a time, and not as a family.
        given: effects taken for part of the description.
        prior: what another log taught; its effects are in `given`.
    """
    hypothesis, kept, start = reading.hypothesis, _kept(reading), None
    take = Taker(log, robot, motion)

    def taken(hypothesis: Hypothesis) -> tuple[Samples, np.ndarray | None]:
        """Windows, and the torque of what is taken for part of the description."""
        samples = take(hypothesis)
        return with_given(samples, given) if given else (samples, None)

    study = asked = None
    at = _BEGUN
    for k in range(ROUNDS):
        # How many rounds there are nobody knows before: each takes its part of what they all may take.
        round_ = _ROUND * (_SELECTED - at)
        tell(at, "laws")
        samples, known = taken(hypothesis)
        asked = Study(
            samples,
            without=without,
            stretch=stretch,
            known=known,
            kept=kept,
            prior=prior,
            first=first,
            single=single,
        )
        tell(at + 0.25 * round_, "laws")
        asked.run(start)
        tell(at + 0.75 * round_, "laws")
        if prior is None and not asked.left.any():  # with structure left, gains would bend to it
            asked.selection = completed(asked)
        study, before = asked, {asked.label(g).identity for g in asked.selection}
        hypothesis, moved = _settled(study, hypothesis, taken)
        at += round_
        start = [asked.label(g) for g in asked.selection]
        if not moved or (k and kept >= before - {("", 0)}):
            break
        kept = kept | (before - {("", 0)})
    assert asked is not None
    tell(at, "laws")
    asked.selection = plainer(asked)
    tell(at + 0.5 * (_SELECTED - at), "laws")
    predicting = by_prediction(asked, bool(asked.left.any()))
    if predicting != asked.selection:
        asked.selection = predicting
        asked.renew()  # what a curve in time took, and nothing does now, is left
    left = asked.left
    if prior is None and not left.any():
        asked.selection = completed(asked)
    tell(_SELECTED, "laws")
    # Where structure is left, or values learnt on another log carry its, the noise as fitted is not all that is wrong.
    plain = bool(left.any()) or prior is not None
    readings = [hypothesis]
    if left.any():  # valued as all else is then, and kept if that predicts better
        readings += [h for h, moved in [_settled(asked, hypothesis, taken, plain=True)] if moved]
    found = []
    for read in readings:
        samples, known = taken(read)
        study = Study(samples, without=without, stretch=stretch, known=known, like=asked, prior=prior)
        undone = [g for g in study.selection if study.label(g).held]
        found.append((study, undone, solve(study, plain=plain, held=undone)))
        tell(_SELECTED + (_SOLVED - _SELECTED) * len(found) / len(readings), "laws")
    study, undone, solution = min(found, key=lambda one: _heldout(one[0], one[2]))
    loose = solution
    bends = add_tangents(study, solution)
    if undone or bends:
        loose = solve(study, plain=plain)
    for g in bends:
        del study.selection[g]
    return Fitted(
        log, robot, motion, reading, take, asked, study, solution, loose, tuple(given), prior, bends
    )


def _heldout(study: Study, solution: Solution) -> float:
    """Root mean square of what is held out, torques as they were recorded [Nm]."""
    left = study.state.hypothesis.recorded(solution.heldout)
    return float(np.sqrt(np.mean(left[study.samples.used] ** 2)))


def with_given(samples: Samples, given: Sequence[ModelEffect]) -> tuple[Samples, np.ndarray]:
    """Windows whose gears carry the loads of some effects too, and the torque (M, n) of all these effects."""
    parts = beside(samples, given).parts
    known = sum((part for _, part in parts), np.zeros_like(samples.y))
    of = laws()
    carried = sum((part for k, part in parts if of[given[k].effect].carried), samples.description)
    state = samples.state.with_torque(np.asarray(carried), samples.description + known)
    return replace(samples, state=state), np.asarray(known)


def _settled(study: Study, hypothesis: Hypothesis, taken, *, plain: bool = False) -> tuple[Hypothesis, bool]:
    """The hypothesis with every undone law of a study's selection in it, the rest refitted until it stands still.

    Args:
        plain: True where every sample counts alike.
    """
    moved = False
    for _ in range(SETTLING):
        hypothesis, again = _undone(study, hypothesis, plain)
        moved = moved or again
        if not again:
            break
        samples, known = taken(hypothesis)
        study = Study(samples, without=study.without, stretch=study.stretch, known=known, like=study)
    return hypothesis, moved


def _kept(reading: Reading) -> frozenset[tuple[str, int]]:
    """Undone laws that the reading holds already."""
    out: set[tuple[str, int]] = set()
    for trial in reading.taken:
        if not trial.law.whole_log:
            joints = range(1, reading.hypothesis.joints + 1) if trial.each else (0,)
            out |= {(trial.law.key, j) for j in joints}
    return frozenset(out)


def _undone(study: Study, hypothesis: Hypothesis, plain: bool) -> tuple[Hypothesis, bool]:
    """The hypothesis with every undone law of the selection in it, and whether that changes anything."""
    moved = False
    held = [g for g in study.selection if study.label(g).held]
    weighed = solve(study, plain=True) if plain and held else None
    for g in held:
        candidate, columns = study.label(g), study.group(g).columns
        if weighed is None:
            values, _ = study.values(g)
        else:
            values = weighed.of(columns)[0] * study.design.scale[columns]
        if np.any(np.abs(values / candidate.law.widths(study.state, candidate.place)) > SETTLED):
            hypothesis, moved = candidate.law.undo(hypothesis, candidate.place, values), True
    return hypothesis, moved
