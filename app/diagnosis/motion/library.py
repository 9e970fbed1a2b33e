"""Every law at every place, and every curve, as groups of columns for one log."""

from __future__ import annotations

import numpy as np

from app import catalog
from app.diagnosis.effects.motion._law import Law
from app.diagnosis.motion.curves import curves
from app.diagnosis.motion.sampling import Samples
from app.diagnosis.motion.system import Group

EFFECTS = "app.diagnosis.effects.motion"


def laws() -> dict[str, Law]:
    """All effects by key."""
    return catalog.members(EFFECTS, "EFFECT")


def law_groups(
    samples: Samples, without: frozenset[str] = frozenset()
) -> tuple[list[tuple[Group, np.ndarray]], list[list[tuple[Group, np.ndarray]]]]:
    """Shared groups (M, n, k) and, per joint, local groups (M, k).

    Args:
        without: keys of effects to leave out.
    """
    state = samples.state
    shared: list[tuple[Group, np.ndarray]] = []
    local: list[list[tuple[Group, np.ndarray]]] = [[] for _ in range(state.joints)]
    for key, law in laws().items():
        if key in without:
            continue
        for place in law.places(state):
            joint = int(place.where["joint"]) - 1 if "joint" in place.where else None
            if joint is not None and not samples.usable[:, joint].any():
                continue
            columns = samples.pool(law.columns(state, place.where, place.shape))
            group = Group(law, place.where, place.shape, joint, columns.shape[-1], base=law.windowed)
            if joint is None:
                shared.append((group, columns))
            else:
                local[joint].append((group, columns))
    return shared, local


def curve_groups(samples: Samples) -> list[list[tuple[Group, np.ndarray]]]:
    """Per joint, the curves that test names and what is left over."""
    out = []
    for j in range(samples.state.joints):
        own = []
        for driver, columns in curves(samples.state, j).items():
            where = {"joint": j + 1} if driver == "pose" else {"joint": j + 1, "driver": driver}
            pooled = samples.pool(columns)
            own.append((Group(None, where, {}, j, pooled.shape[1], name=driver), pooled))
        out.append(own)
    return out
