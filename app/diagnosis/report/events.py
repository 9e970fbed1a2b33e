"""What a diagnosis says happened at a time: a contact, a load taken up, a step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.result import Diagnosis


@dataclass(frozen=True)
class Event:
    """One finding on the time axis.

    Args:
        number: of the finding, from 1.
        start, end: [s]; an open end runs to the end of the recording.
    """

    number: int
    start: float
    end: float


def events_of(diagnosis: Diagnosis) -> tuple[Event, ...]:
    """Findings that point at a time, in their order."""
    evidence = diagnosis.evidence
    seconds = None if evidence is None else evidence.seconds
    last = float(seconds[-1]) if seconds is not None and len(seconds) else np.inf
    return tuple(
        Event(k, float(f.where["from_s"]), float(f.where.get("to_s", last)))
        for k, f in enumerate(diagnosis.findings, 1)
        if f.where.get("from_s") is not None
    )
