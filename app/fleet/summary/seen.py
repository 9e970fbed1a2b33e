"""Rows as what was found in which arm, and when."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import msgspec

from app.fleet.work import Row

#: What of a place tells one effect from another over many recordings: rows and times belong to one recording.
_LASTING = ("body", "joint", "link", "axis", "source_joint", "driver", "order")


@dataclass(frozen=True)
class What:
    """An effect at a place of an arm; the same in every recording.

    Args:
        effect: its key.
        where: the lasting part of its place, as (key, value).
    """

    effect: str
    where: tuple[tuple[str, Any], ...]

    @property
    def place(self) -> dict[str, Any]:
        """As a finding says it."""
        return dict(self.where)


@dataclass(frozen=True)
class Value:
    """One number of an effect in one recording: value and standard error, in SI `unit`."""

    name: str
    value: float
    std: float
    unit: str


@dataclass(frozen=True)
class Seen:
    """One recording that was read.

    Args:
        file, arm: which it is, and whose.
        recorded: when it was made [s since 1970].
        run: number of the run that read it.
        verdict: as a diagnosis says.
        found: what, with its numbers.
    """

    file: str
    arm: str
    recorded: float
    run: int
    verdict: str
    found: Mapping[What, tuple[Value, ...]]


def seen(row: Row) -> Seen:
    """A row that has a diagnosis; raises ValueError where that cannot be read."""
    told = msgspec.json.decode(row.diagnosis)
    found: dict[What, tuple[Value, ...]] = {}
    for finding in told["findings"]:
        where = tuple(
            (key, finding["where"][key]) for key in _LASTING if finding["where"].get(key) is not None
        )
        found[What(finding["effect"], where)] = tuple(
            Value(p["name"], p["value"], p["std"], p["unit"])
            for p in finding["parameters"]
            if p["value"] is not None and p["std"] is not None
        )
    return Seen(row.file, row.arm, row.recorded or 0.0, row.run, row.verdict, found)
