"""What is carried to poses where mechanisms and what has no name say nothing: the calibration found without them.

There it is all that an ordinary calibration fits, and not the part of it that was left beside the rest: lengths alone
stand in for zeros and twists as well, and by centimetres elsewhere. Its widths are learnt beside the noise that it
leaves itself, which is more than what is left when all is explained, and hangs together from row to row.
"""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.kinematic.description import Description
from app.diagnosis.kinematic.spread import memory_of

#: Rounds in which calibration and how its errors hang together are fitted in turn.
_ROUNDS = 3


def changes(
    found: Description, weights: np.ndarray, spoken: frozenset[tuple], local: bool
) -> tuple[dict[int, np.ndarray], np.ndarray]:
    """By how much calibration would be another if nothing held but it and what has a name.

    With G = X'X + t Gamma^-1 of all calibration it is G^-1 X'y; of this, mechanisms change G^-1 X'U w, by joint. t is
    the number of rows that count as one, (1 + r) / (1 - r) for errors of correlation r with the row before.

    Args:
        weights: (p,) of all columns, in nominal sizes.
        spoken: labels of the terms that are findings.
        local: True where what has no name does not hold elsewhere either.

    Returns:
        joint -> (p,) what calibration has elsewhere for that joint's mechanisms, and (p,) what it has among the
        recording's poses beside: calibration elsewhere is weights + the sum of the former - the latter.
    """
    linear, design = found.linear, found.linear.design
    none, (gamma, everywhere) = np.zeros(design.size), _widths(found)
    low = np.flatnonzero(gamma)
    upper, rest = _others(found, spoken, local)
    if not low.size or not (everywhere or upper):  # laws alone are elsewhere what they are here
        return {}, none
    rest = np.setdiff1d(rest, low)
    own, prior = design.matrix[np.ix_(low, low)], np.diag(1.0 / gamma[low])
    right = design.right[low] - design.matrix[np.ix_(low, rest)] @ weights[rest]
    alone, inside, gram = none.copy(), np.union1d(low, rest), own + prior
    alone[rest] = weights[rest]
    for _ in range(_ROUNDS):
        alone[low] = np.linalg.solve(gram, right)
        left = design.left(inside, alone[inside]).reshape(len(found.rows), -1)
        memory = memory_of(left * (linear.state.weights > 0))
        gram = own + (1.0 + memory) / (1.0 - memory) * prior
    out: dict[int, np.ndarray] = {}
    for joint, columns in upper.items():
        out[joint] = none.copy()
        out[joint][low] = np.linalg.solve(gram, design.matrix[np.ix_(low, columns)] @ weights[columns])
    beside = none.copy()
    beside[low] = (weights + sum(out.values(), none) - alone)[low]
    return out, beside


def _widths(found: Description) -> tuple[np.ndarray, bool]:
    """(p,) widths of calibration, 0 for other columns, and whether the arm is off everywhere.

    Then it is all that is ordinarily fitted, learnt without what mechanisms and what has no name explain; else the laws
    that are in.
    """
    linear, evidence = found.linear, found.evidence
    effects = [[found.library.fixed[n].effect for n in linear.members[g]] for g in range(len(linear.groups))]
    lower = {g for g, of in enumerate(effects) if all(e.level == Level.CALIBRATION for e in of)}
    ordinary = {
        g for g in lower if isinstance(linear.groups[g].label, str) and all(e.always for e in effects[g])
    }
    chosen = {g: v for g, v in found.selection.items() if g in lower}
    everywhere = bool(ordinary & set(chosen))
    if everywhere:
        kept, alike = evidence.kept, evidence.alike
        evidence.kept, evidence.alike = ordinary, {g for g in ordinary if all(e.built for e in effects[g])}
        chosen = evidence.tuned({**dict.fromkeys(ordinary, 1.0), **chosen})
        evidence.kept, evidence.alike = kept, alike
    gamma = np.zeros(linear.design.size)
    for g, width in chosen.items():
        gamma[linear.groups[g].columns] += width
    return gamma, everywhere


def _others(
    found: Description, spoken: frozenset[tuple], local: bool
) -> tuple[dict[int, np.ndarray], np.ndarray]:
    """Joint -> columns of its mechanisms without a name, and columns of all else that is in."""
    upper: dict[int, list[int]] = {}
    rest: list[int] = []
    for number in found.numbers():
        candidate, columns = found.library.fixed[number], found.linear.columns[number].tolist()
        level, lasts = candidate.effect.level, candidate.effect.lasts(candidate.place.where)
        fades = level == Level.MECHANISM or (local and level == Level.UNKNOWN)
        if fades and lasts and candidate.label not in spoken:
            upper.setdefault(int(candidate.place.where.get("joint", 0)), []).extend(columns)
        else:
            rest += columns
    return {joint: np.unique(np.array(of, int)) for joint, of in upper.items()}, np.array(rest, int)
