"""From a description to findings: members by their own weight in the whole model, rivals as sets, p values."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.kinematic.description import Description
from app.diagnosis.models.kinematic.candidates import Candidate
from app.diagnosis.regression.evidence import Evidence, Group, Selection
from app.diagnosis.regression.nulls import null_gains, p_value
from app.diagnosis.result import Alternative, Finding
from app.diagnosis.selection.search import Search
from app.diagnosis.thresholds.evidence import UNKNOWN
from app.diagnosis.thresholds.naming import (
    MEMBER_MOVES,
    MEMBER_SHARED,
    MEMBER_WALD,
    MEMBER_WALD_PARAMETER,
    POSES_A_NAME,
    RIVAL,
    SAME_PLACE_SHARE,
)

#: Findings whose rivals are looked for, the weightiest first: further ones are hundredths of the mismatch.
_MOST_RIVALS = 12


@dataclass(frozen=True, eq=False)
class Named:
    """A candidate that is a finding.

    Args:
        number: of the candidate.
        values, covariance: SI.
        moves: rms of what it explains, in noise sigmas.
        gain: nats that it holds against its removal.
    """

    number: int
    values: np.ndarray
    covariance: np.ndarray
    moves: float
    gain: float


def named(found: Description) -> list[Named]:
    """The candidates that are findings, the one that moves most first."""
    out = []
    alone = {
        found.linear.groups[g].label: g
        for g in found.selection
        if isinstance(found.linear.groups[g].label, int)
    }
    score = found.evidence.score(found.selection)
    unknown = _unknown_moves(found)
    for number in found.numbers():
        candidate, columns = found.library.fixed[number], found.linear.columns[number]
        if candidate.effect.level == Level.UNKNOWN or candidate.effect.serving or not len(columns):
            continue
        weights, covariance = found.posterior.of(columns)
        moves = _moves(found, columns, weights)
        wald = float(weights @ np.linalg.solve(covariance, weights))
        # Beside a family that has its columns too, a law alone loses nothing when it falls: the family takes it over.
        if number in alone and not _in_family(found, alone[number]):
            rest = {k: v for k, v in found.selection.items() if k != alone[number]}
            gain = score - found.evidence.score(rest)
        else:
            gain = 0.5 * wald
        least = MEMBER_WALD + MEMBER_WALD_PARAMETER * len(columns)
        if (found.dense or number not in alone) and (wald < least or moves < MEMBER_MOVES):
            continue
        if _impossible(found, candidate, weights) or _covered(candidate, moves, unknown):
            continue
        if found.shared is not None and number in found.shared:
            alike, spread = found.shared[number]
            if float(alike @ np.linalg.solve(spread, alike)) < MEMBER_SHARED:
                continue  # with all laws on one level another takes its place
            covariance = covariance + np.diag((0.5 * (weights - alike)) ** 2)
            if float(weights @ np.linalg.solve(covariance, weights)) < MEMBER_SHARED:
                continue  # how much is its own hangs on who is asked first
        scale = candidate.widths
        out.append(Named(number, weights * scale, covariance * np.outer(scale, scale), moves, gain))
    out = sorted(out, key=lambda n: -n.moves)
    borne = max(len(np.unique(found.state.recording.pose)) // POSES_A_NAME, 1)
    out = out[:borne]
    return out if found.dense else _told_apart(found, out)


def _in_family(found: Description, g: int) -> bool:
    """True where another selected group has columns of this one."""
    groups = found.linear.groups
    own = set(groups[g].columns.tolist())
    return any(own & set(groups[h].columns.tolist()) for h in found.selection if h != g)


def _told_apart(found: Description, names: list[Named]) -> list[Named]:
    """On a sound description, several laws of one joint along its own angle are a curve that has no name."""
    sites = [_site(found.library.fixed[n.number]) for n in names]
    several = {s for s in sites if isinstance(s, tuple) and s[1] == "own_angle" and sites.count(s) > 1}
    return [n for n, s in zip(names, sites, strict=True) if s not in several]


def _moves(found: Description, columns: np.ndarray, weights: np.ndarray) -> float:
    moved = found.linear.design.predicted(columns, weights)
    return float(np.sqrt(moved @ moved / max(found.linear.design.dof, 1)))


def _impossible(found: Description, candidate: Candidate, weights: np.ndarray) -> bool:
    """A value on the wrong side of a physical bound is part of the fit, not a name."""
    quantities = candidate.effect.quantities(found.library.situation, candidate.place)
    values = weights * candidate.widths
    return any(v < q.lower or v > q.upper for q, v in zip(quantities, values, strict=True))


def _unknown_moves(found: Description) -> dict[object, float]:
    """Place -> how much unnamed parts move there [noise sigmas]."""
    out: dict[object, float] = {}
    for number in found.numbers():
        candidate, columns = found.library.fixed[number], found.linear.columns[number]
        if candidate.effect.level == Level.UNKNOWN and len(columns):
            weights, _ = found.posterior.of(columns)
            place = _site(candidate)
            out[place] = float(np.hypot(out.get(place, 0.0), _moves(found, columns, weights)))
    return out


def _site(candidate: Candidate) -> object:
    where = candidate.place.where
    return (where.get("joint"), where.get("driver")) if "joint" in where else where.get("body")


def _covered(candidate: Candidate, moves: float, unknown: dict[object, float]) -> bool:
    """True where an unnamed part at the same joint, along the same driver, is needed beside it for a good share."""
    where = candidate.place.where
    if "joint" not in where or "driver" not in where:
        return False
    return unknown.get(_site(candidate), 0.0) > SAME_PLACE_SHARE * moves


def findings(
    found: Description, names: list[Named], heldout_mm: float, chance_seed: int
) -> tuple[Finding, ...]:
    """Findings with their rivals.

    Args:
        heldout_mm: of the whole model.
    """
    if not names:
        return ()
    chance = _chance(found, chance_seed)
    dof = max(found.linear.design.dof, 1)
    left = found.linear.design.left(found.posterior.columns, found.posterior.weights)
    rest = float(left @ left)
    situation = found.library.situation
    out = []
    for rank, name in enumerate(names):
        candidate = found.library.fixed[name.number]
        parameters = candidate.effect.report(situation, candidate.place, name.values, name.covariance)
        without = heldout_mm * float(np.sqrt((rest + name.moves**2 * dof) / max(rest, 1e-300)))
        out.append(
            Finding(
                effect=candidate.effect.key,
                where=dict(candidate.place.where),
                parameters=parameters,
                visible=found.linear.visible.get(name.number, 1.0),
                p_value=p_value(name.gain, chance),
                heldout_rms_without=without,
                heldout_rms_with=heldout_mm,
                alternatives=rivals(found, name) if rank < _MOST_RIVALS else (),
                sentence=candidate.effect.sentence(candidate.place, parameters),
                equation=candidate.effect.equation,
            )
        )
    return tuple(out)


def _chance(found: Description, seed: int) -> np.ndarray:
    laws = [
        g
        for g, group in enumerate(found.linear.groups)
        if isinstance(group.label, int) and len(group.columns) <= 6
    ]
    design = found.linear.design
    left = design.left(found.posterior.columns, found.posterior.weights)
    rows = np.repeat(np.arange(len(found.state.residual)), found.state.weights.shape[1])
    return null_gains(found.evidence, design, left, rows, laws, seed)


def rivals(found: Description, name: Named) -> tuple[Alternative, ...]:
    """Other laws that explain the data about as well in its place, the others refitted."""
    evidence, selection, own = _without(found, name.number)
    laws = [
        g
        for g, group in enumerate(evidence.groups)
        if isinstance(group.label, int)
        and g not in selection
        and group.label != name.number
        and found.library.fixed[group.label].effect.level != Level.UNKNOWN
    ]
    if not laws:
        return ()
    gains, _ = evidence.gains(selection, [own, *laws])
    out = []
    for g, gain in zip(laws, gains[1:], strict=True):
        behind = float(gains[0] - gain)
        if behind < RIVAL:
            candidate = found.library.fixed[evidence.groups[g].label]  # type: ignore[index]
            out.append(Alternative(candidate.effect.key, dict(candidate.place.where), 2.0 * behind))
    return tuple(sorted(out, key=lambda a: a.delta_bic))


def _without(found: Description, number: int) -> tuple[Evidence, Selection, int]:
    """The evidence with a candidate taken out of every group that holds it, and its own group."""
    columns = set(found.linear.columns[number].tolist())
    groups, selection, own = list(found.linear.groups), {}, -1
    for g, gamma in found.selection.items():
        group = groups[g]
        if group.label == number and isinstance(group.label, int):
            continue
        if columns & set(group.columns.tolist()):
            rest = np.array([c for c in group.columns if int(c) not in columns], int)
            if not len(rest):
                continue
            groups.append(Group(rest, group.penalty, group.cap, label=group.label))
            selection[len(groups) - 1] = gamma
        else:
            selection[g] = gamma
    own = next(g for g, group in enumerate(groups) if group.label == number and isinstance(group.label, int))
    return Evidence(found.linear.design, groups), selection, own


def imitated(found: Description) -> Candidate | None:
    """A smooth law without a name that several named ones may only imitate, if there is one.

    Two laws of one joint along its own angle bend to any curve; and where an unnamed law replaces several at nearly
    the same evidence, every further name has to earn as much as the unnamed law costs.
    """
    along = [found.library.fixed[n] for n in _in_alone(found)]
    along = [c for c in along if c.place.where.get("driver") == "own_angle"]
    for candidate in along:
        if sum(c.place.where.get("joint") == candidate.place.where.get("joint") for c in along) > 1:
            return candidate
    laws = [g for g in found.selection if isinstance(found.linear.groups[g].label, int)]
    if found.dense or len(laws) < 2:
        return None
    score = found.evidence.score(found.selection)
    for u, group in enumerate(found.linear.groups):
        if not isinstance(group.label, int) or u in found.selection:
            continue
        if found.library.fixed[group.label].effect.level != Level.UNKNOWN:
            continue
        trial = Search(found.evidence, lambda selection, among=None: (), drop=UNKNOWN).pruned(
            found.evidence.tuned({**found.selection, u: 1.0}, 1)
        )
        fewer = len(found.selection) - len(trial)
        if u in trial and fewer > 0 and found.evidence.score(trial) > score - UNKNOWN * fewer:
            return found.library.fixed[group.label]
    return None


def _in_alone(found: Description) -> list[int]:
    """Numbers of the candidates that are in as groups of their own."""
    labels = [found.linear.groups[g].label for g in found.selection]
    return [label for label in labels if isinstance(label, int)]
