"""Columns that are made of the torque a fit finds: laws of load, and factors of what the drives give."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.dynamic.library import label

if TYPE_CHECKING:
    from app.diagnosis.dynamic.study import Study


def follow_load(study: Study) -> None:
    """Renews them from the masses, loads and friction of a study's selection; its design waits for `whiten`."""
    found = study.posterior()
    carried, given = np.zeros(len(found.columns), bool), np.zeros(len(found.columns), bool)
    for g in study.selection:
        law, columns = study.label(g).law, study.group(g).columns
        if law.undone:  # a factor of what the drives give is none of it
            continue
        own = np.isin(found.columns, columns) & ~given  # a law and its family may both be in
        given |= own
        carried |= own & law.carried
    torque, drive = (
        start + study.design.prediction(found.columns[which], found.weights[which])
        for start, which in ((study.rigid, carried), (study.base, given))
    )
    loaded = study.state.with_torque(torque, drive)
    study.state = study.events.state = loaded
    for group in study.evidence.groups:
        law, place = label(group).law, label(group).place
        if law.follows_load and not label(group).whole:
            new = law.columns(loaded, place)
            for k, number in enumerate(group.columns):
                study.design.replace(int(number), {j: c[:, k] for j, c in new.items()})
