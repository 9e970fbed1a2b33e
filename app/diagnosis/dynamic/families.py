"""Families of a study: what every joint and link of a real arm has, taken as one group each."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.dynamic.library import label, nominal
from app.diagnosis.regression.evidence import Selection
from app.diagnosis.thresholds.evidence import SMALL_FACTOR

if TYPE_CHECKING:
    from app.diagnosis.dynamic.study import Study


def families(study: Study) -> Selection:
    """All links, dry and viscous friction, offsets, rests, rotors and drive gains of all joints."""
    kept = {study.label(k).law.key for k in study.evidence.kept}
    groups = enumerate(study.evidence.groups)
    return {g: nominal(x) for g, x in groups if label(x).whole and label(x).law.key not in kept}


def ordinary(study: Study) -> list[int]:
    """What an ordinary identification fits: masses, friction, offsets, rotors; of a single joint its own."""
    found = dict(enumerate(study.evidence.groups))
    whole = {label(x).law.key for x in found.values() if label(x).whole}
    alone = [g for g, x in found.items() if label(x).law.whole and label(x).law.key not in whole]
    every = [*families(study), *alone]
    laws = {g: study.label(g).law for g in every}
    return [g for g, law in laws.items() if law.lasting and not law.undone]


def _within_trust(study: Study, g: int) -> bool:
    """True for a factor of a joint, or of all, that masses and drives as they are made have among them."""
    candidate = study.label(g)
    if not candidate.held or not candidate.law.sure or g in study.evidence.kept:
        return False
    return bool(np.all(np.abs(study.values(g)[0]) <= SMALL_FACTOR))


def completed(study: Study) -> Selection:
    """The selection of an arm that is off everywhere, with masses and drive gains within their trust.

    Where friction or rotors of all joints are in, masses and gains are off too, whether this log shows it or not: every
    value is as sure as they let it be. A single factor that small is one of them.
    """
    chosen = study.selection
    own = {study.label(g).law.key for g in chosen if study.label(g).whole and study.label(g).law.lasting}
    if not own:
        return chosen
    small = {g for g in chosen if _within_trust(study, g)}
    chosen = {g: v for g, v in chosen.items() if g not in small}
    there = own | {study.label(g).law.key for g in chosen if study.label(g).held}
    laws = {g: (study.label(g).law, v) for g, v in families(study).items()}
    more = {g: v for g, (law, v) in laws.items() if law.sure and law.key not in there}
    inside = {c for g in more for c in study.group(g).columns.tolist()}
    rest = {g: v for g, v in chosen.items() if not inside & set(study.group(g).columns.tolist())}
    return {**rest, **more}


def plainer(study: Study) -> Selection:
    """The selection with every law that adds nothing to one it contains exchanged for that one, by the evidence.

    Beside a family of small constants of all joints the large one of a single joint cannot enter: it would take the
    family's place. So a spring enters instead, whose stiffness is nothing and whose constant is that joint's.
    """
    now, laws = study.selection, [label(group) for group in study.evidence.groups]
    for g in [g for g in now if study.label(g).law.contains]:
        law, joint = study.label(g).law, study.label(g).place.where["joint"]
        inside = [c for c in laws if c.law.key == law.contains and not c.whole]
        inner = next((c for c in inside if c.place.where["joint"] == joint), None)
        if inner is None:
            continue
        own = study.add(inner.law, inner.place, inner.needs)
        rest = {k: v for k, v in now.items() if k != g}
        trial = max(({**rest, own: float(v)} for v in study.group(own).widths), key=study.evidence.score)
        now = trial if study.evidence.score(trial) > study.evidence.score(now) else now
    return now
