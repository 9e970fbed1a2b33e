"""What the groups of a study are: laws at places, and how one is found again under another hypothesis."""

from __future__ import annotations

from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.library import Candidate
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.regression.evidence import Group


def identity(candidate: Candidate) -> tuple[str, int]:
    """Key and joint of a law that is undone; 0 for the whole arm."""
    if not candidate.held:
        return "", 0
    return candidate.law.key, int(candidate.place.where.get("joint", 0))


def fresh(candidate: Candidate, state: State) -> Place:
    """The place of a law; of one that is undone with what the hypothesis now holds of it."""
    if candidate.law.undone:
        for place in candidate.law.places(state):
            if place.where == candidate.place.where:
                return place
    return candidate.place


def label(group: Group) -> Candidate:
    """What a group is."""
    assert isinstance(group.label, Candidate)
    return group.label


def place_key(place) -> tuple:
    """Where, and the form; what a hypothesis holds already is no part of it."""
    form = {k: v for k, v in place.fixed.items() if not k.startswith("fixed_")}
    return tuple(sorted(place.where.items())), tuple(sorted(form.items())), place.fixed.get("fixed_sense")
