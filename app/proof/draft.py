"""One sealed case before it is made: what is to be recorded and what is wrong in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from app.proof.generator.effects.term import Request


@dataclass(frozen=True)
class Draft:
    """A case as drawn.

    Args:
        plan: how the recording is made.
        requests: the effects in it.
        clutter: one-sigma error of every length of the arm as built [m]; 0 for an arm as described.
        wrong_masses: share by which the masses differ from the description.
    """

    plan: Any
    requests: Sequence[Request] = field(default=())
    clutter: float = 0.0
    wrong_masses: float = 0.0


class Stratum(Protocol):
    """What every file under strata/ holds as `STRATUM`.

    Args:
        share: of all cases.
        names_nothing: True where no finding is right.
    """

    key: str
    title: str
    share: float
    names_nothing: bool

    def draft(self, rng: np.random.Generator) -> Draft: ...
