"""The error budget: where the millimetres come from."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.effect import Level, Place
from app.diagnosis.kinematic.description import Description
from app.diagnosis.kinematic.elsewhere import changes
from app.diagnosis.models.kinematic.saved import reach_of
from app.diagnosis.models.kinematic.terms import Term
from app.diagnosis.regression.heldout import folds_of, heldout_residuals
from app.diagnosis.result import STATIC_FAMILIES, UNNAMED, FamilyShare
from app.units import mm

#: Of its nominal size: below, a part of a law is nothing.
_NONE = 1e-4


def shared_terms(
    found: Description, spoken: frozenset[tuple] = frozenset(), local: bool = False
) -> list[tuple[str, Term]]:
    """Every part of the model with the family it counts to.

    A mechanism holds as far as its own joint was seen to turn, what has no name where all joints were seen. Elsewhere
    the calibration holds that would have been found without it (elsewhere.py), unless it has a name of its own: so a
    model that is carried far is no worse than a calibration.
    What has no name takes back from lower columns (see levels.py) counts as without a name.

    Args:
        spoken: labels of the terms that are findings.
        local: True where mechanisms and what has no name, as far as they are no findings, say nothing of other poses
            (regions.py): they then hold among poses like those of the recording alone.
    """
    library, linear = found.library, found.linear
    q = found.state.recording.q
    ranges = np.array([q.min(axis=0), q.max(axis=0)])
    weights = np.zeros(linear.design.size)
    weights[found.posterior.columns] = found.posterior.weights
    back = _taken_back(found, weights, ranges)
    without, beside = changes(found, weights, spoken, local)
    out: list[tuple[str, Term]] = []
    for number, columns in linear.columns.items():
        candidate = library.fixed[number]
        family, own = candidate.effect.family, None
        if candidate.effect.level == Level.MECHANISM:
            own = reach_of(ranges, candidate.place.where.get("joint", 0))
        elif candidate.effect.level == Level.UNKNOWN:
            own = _holds(candidate.place, ranges)
        near = local and candidate.effect.level != Level.CALIBRATION and candidate.label not in spoken
        everywhere = weights[columns] + sum(w[columns] for w in without.values()) - beside[columns]
        parts = [(family, everywhere, own, near)]
        parts += [(UNNAMED, taken[columns], reach, local) for reach, taken in back]
        parts += [(family, -w[columns], reach_of(ranges, j), local) for j, w in without.items()]
        parts += [(family, beside[columns], ranges, local)]
        for counted, values, reach, among in parts:
            if np.abs(values).max(initial=0.0) > _NONE:
                reach = None if among else reach
                term = Term(
                    candidate.effect, candidate.place, values * candidate.widths, reach=reach, near=among
                )
                out.append((counted, term))
    return out


def _holds(place: Place, ranges: np.ndarray) -> np.ndarray | None:
    """Between which joint positions a part without a name holds, of those that were recorded (2, n).

    A curve over a joint's own angle holds as far as this joint was seen to turn. One over a load fades by itself beyond
    the loads that were seen, and angles say nothing of it. What follows several joints or the place of the tool holds
    where all joints were seen.
    """
    driver = place.where.get("driver")
    if driver == "gravity_torque":
        return None
    return reach_of(ranges, place.where["joint"] if driver in ("own_angle", "approach") else 0)


def _taken_back(
    found: Description, weights: np.ndarray, ranges: np.ndarray
) -> list[tuple[np.ndarray | None, np.ndarray]]:
    """What parts without a name take back from lower columns, by where those parts hold."""
    linear = found.linear
    out: dict[bytes, tuple[np.ndarray | None, np.ndarray]] = {}
    for number, columns in linear.columns.items():
        candidate = linear.library.fixed[number]
        if candidate.effect.level != Level.UNKNOWN or not np.any(weights[columns]):
            continue
        reach = _holds(candidate.place, ranges)
        taken = linear.design.expanded(columns, weights[columns])
        taken[columns] -= weights[columns]
        key = b"" if reach is None else reach.tobytes()
        out[key] = (reach, taken if key not in out else out[key][1] + taken)
    return list(out.values())


def shares(found: Description, parts: list[tuple[str, Term]], noise: float) -> dict[str, float]:
    """Family -> part of the mean square of `before`, above noise, that is lost without it.

    The other families stay as they are; base, tool and touched points are fitted anew.

    Args:
        noise: known noise over the noise that is left, squared, where it is known; else 1.
    """
    left = found.linear.design.response - _predicted(found, parts)
    total = found.linear.design.response
    rss = float(left @ left)
    above = max(float(total @ total) - rss * min(noise, 1.0), 1e-300)
    out: dict[str, float] = {}
    for family in dict.fromkeys(f for f, _ in parts):
        lost = left + _predicted(found, [p for p in parts if p[0] == family])
        out[family] = float(np.clip((lost @ lost - rss) / above, 0.0, 1.0))
    return out


def _predicted(found: Description, parts: list[tuple[str, Term]]) -> np.ndarray:
    """(N,) what these parts explain, the set-up projected off."""
    linear = found.linear
    out = np.zeros(linear.state.weights.size)
    for _, term in parts:
        block = term.effect.columns(linear.sensitivity, term.place).reshape(len(out), -1)
        out += block @ term.values
    return linear.design.projected(out[:, None])[:, 0]


def heldout_after(found: Description, kept: np.ndarray) -> dict[str, float]:
    """Family -> held-out error [mm] of a model with it and all families before it, refitted at the learnt widths."""
    linear, recording = found.linear, found.state.recording
    precision, response = found.precisions(), found.response()
    fold = np.repeat(folds_of(recording.pose), linear.state.weights.shape[1])
    scale = np.where(linear.state.weights > 0, linear.state.weights, 1.0).reshape(-1)
    counted = (recording.present & ~recording.angular & kept[:, None]).reshape(-1)
    columns, prior = [linear.free], [np.zeros(linear.free.shape[1])]
    said, prefixes = [], []
    for family in STATIC_FAMILIES:
        inside = [n for n in precision if linear.library.fixed[n].effect.family == family]
        for number in inside:
            columns.append(linear.raw(linear.library.fixed[number]))
            prior.append(np.full(columns[-1].shape[1], precision[number]))
        if inside:
            said.append(family)
            prefixes.append(sum(len(p) for p in prior))
    every = heldout_residuals(
        np.hstack(columns), response, np.concatenate(prior), fold, prefixes, linear.absorbed
    )  # fmt: skip
    out: dict[str, float] = {}
    for family, left in zip(said, every, strict=True):
        held = (left / scale)[counted]
        held = held[np.isfinite(held)]
        out[family] = mm(float(np.sqrt(np.mean(held**2)))) if held.size else 0.0
    return out


def families(
    found: Description,
    parts: list[tuple[str, Term]],
    family_of: list[str],
    after: dict[str, float],
    undone_share: float,
    plain_mm: float,
    noise: float,
) -> tuple[FamilyShare, ...]:
    """The budget in the contract's order.

    Args:
        family_of: of each finding.
        after: from `heldout_after`.
        undone_share: part of the mean square of `before` that undone conventions took; 0 where there were none.
        plain_mm: held-out error after conventions were undone [mm].
        noise: see `shares`.
    """
    share = shares(found, parts, noise)
    out, last = [], plain_mm
    for family in STATIC_FAMILIES:
        members = tuple(i for i, f in enumerate(family_of) if f == family)
        if family == "conventions" and undone_share > 0:
            out.append(FamilyShare(family, undone_share, plain_mm, members))
        elif family in share:
            last = after.get(family, last)
            out.append(FamilyShare(family, share[family] * (1.0 - undone_share), last, members))
    return tuple(out)
