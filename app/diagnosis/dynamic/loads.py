"""A change of one link's masses: is the link itself heavier, or is a load fixed to it?

Both have the same ten columns, so no motion tells them apart but by what the values are. A link that is heavier keeps
its centre, within the trust that the description deserves; a load has a centre of its own and a mass above nothing.
With P the precision of mass and first moment by the log alone, b = P times their values, the evidence of x ~ N(0, S) is

    1/2 b' (S^-1 + P)^-1 b - 1/2 ln |I + S P|.

Against another log of the arm its links are what they were, and what was added is a load.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.dynamic.names import Member
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.library import Candidate, laws
from app.diagnosis.thresholds.evidence import NOMINAL
from app.diagnosis.thresholds.naming import RIVAL
from app.diagnosis.thresholds.naming_logs import HEAVIER, LOAD_MASS, LOAD_SURE, STANDS_OUT, WEIGHED
from app.kinematics.dynamics import PER_LINK

if TYPE_CHECKING:
    from app.diagnosis.dynamic.study import Study


SHOWN = 4  # mass and first moment: the rest of a body hardly shows
TRIED = 61  # weights of a load, over those that the log leaves open


def told_as_load(study: Study, member: Member, nominal: np.ndarray, complete: bool) -> Member:
    """The member, as a load where it is one; with the other reading listed where the log cannot exclude it.

    Args:
        member: of any law; only masses of a single link are looked at.
        nominal: (10 n,) the description's inertial parameters.
        complete: False where more than noise is left, which a load whose weight is open may only stand in for.
    """
    law, where = member.candidate.law, member.candidate.place.where
    if not law.added or not member.named or int(where["link"]) == study.state.joints:
        return member
    place = Place({"link": int(where["link"])})
    load = laws()[law.added]
    weighed = member.values[0] > WEIGHED * np.sqrt(max(member.covariance[0, 0], 0.0))
    possible = weighed and load.lawful(load.saved(place, member.values))
    if study.prior is not None:
        light = _as_light(study, member) if complete and not possible else None
        added = member if possible else light
        if added is None:
            return replace(member, named=False)
        return replace(added, candidate=Candidate(load, place))
    better = _nats(study, member, nominal) if possible else -np.inf
    if better > LOAD_SURE:
        return replace(member, candidate=Candidate(load, place))
    if better > -RIVAL:
        return replace(member, alike=((Candidate(load, place), LOAD_SURE - better),))
    return member


def _as_light(study: Study, member: Member) -> Member | None:
    """The member as a load whose weight the log does not tell, only its moment: as light as one can be that reaches no
    further than the link is large. None where no weight that the log leaves open is one of a load, or where it
    explains no more than laws that are missing might.
    """
    explained = study.design.prediction(member.columns, member.values / study.design.scale[member.columns])
    spread = np.array([whitener.spread for whitener in study.design.whiteners])
    if not np.any(np.sqrt(np.mean(explained**2, axis=0)) > STANDS_OUT * spread):
        return None
    size = float(study.state.link_size[int(member.candidate.place.where["link"]) - 1])
    values, with_mass = member.values, member.covariance[:, 0]
    variance = max(float(with_mass[0]), 1e-300)
    open_by = WEIGHED * float(np.sqrt(variance))
    for mass in np.linspace(values[0] - open_by, values[0] + open_by, TRIED):
        moved = values + with_mass / variance * (mass - values[0])
        if mass > 0.0 and np.linalg.norm(moved[1:SHOWN]) <= size * mass:
            return replace(member, values=moved)
    return None


def _nats(study: Study, member: Member, nominal: np.ndarray) -> float:
    """nats by which a load explains the values better than a heavier or lighter link."""
    k = int(member.candidate.place.where["link"]) - 1
    state = study.state
    own = nominal[PER_LINK * k : PER_LINK * k + SHOWN]
    mass, size = float(state.link_mass[k]), float(state.link_size[k])
    trust = NOMINAL * study.stretch.get(member.candidate.law.key, 1.0)
    scale = study.design.scale[member.columns][:SHOWN]
    known = 1.0 / (study.selection[member.group] * scale**2)
    inverse = np.linalg.pinv(member.covariance[:SHOWN, :SHOWN], hermitian=True)
    right = inverse @ member.values[:SHOWN]
    values, vectors = np.linalg.eigh(inverse - np.diag(known))
    half = vectors * np.sqrt(np.maximum(values, 0.0))  # what the log says, without the prior
    link = (HEAVIER**2) * np.outer(own, own) + np.diag((trust * mass * np.array([1.0, *[size] * 3])) ** 2)
    heavy = LOAD_MASS * float(state.link_mass.sum())
    load = np.diag((heavy * np.array([1.0, *[size] * 3])) ** 2)
    return _evidence(load, half, right) - _evidence(link, half, right)


def _evidence(spread: np.ndarray, half: np.ndarray, right: np.ndarray) -> float:
    root = np.linalg.cholesky(spread + 1e-12 * np.trace(spread) * np.eye(len(spread)))
    inner = root.T @ half
    block = np.eye(len(spread)) + inner @ inner.T
    along = root.T @ right
    return 0.5 * float(along @ np.linalg.solve(block, along)) - 0.5 * float(np.linalg.slogdet(block)[1])
