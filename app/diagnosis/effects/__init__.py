"""Effects of both kinds of recordings, found by the files they live in."""

from __future__ import annotations

from typing import Any

from app import catalog

#: Kind of recording, as a result and a saved model name it -> where its effects live.
FOLDERS = {"static": "app.diagnosis.effects.kinematic", "motion": "app.diagnosis.effects.dynamic"}


def of_kind(kind: str) -> dict[str, Any]:
    """Every effect of a kind of recording, by key."""
    return catalog.members(FOLDERS[kind], "EFFECT")


def named(key: str, kind: str) -> Any:
    """The effect with this key, of this kind of recording where both kinds have one; None where there is none."""
    found = of_kind(kind).get(key)
    others = (of_kind(other).get(key) for other in FOLDERS if other != kind)
    return found if found is not None else next((effect for effect in others if effect is not None), None)
