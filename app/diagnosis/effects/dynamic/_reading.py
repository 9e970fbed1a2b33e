"""Another way to read a log, which an effect that is undone offers to try before anything is fitted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from app.diagnosis.effects.effect import Effect, Place
from app.diagnosis.models.dynamic.hypothesis import Hypothesis

if TYPE_CHECKING:
    from app.diagnosis.models.dynamic.samples import Samples


class Read(Protocol):
    """A log under a reading, with friction of each joint ready to be projected off."""

    samples: Samples

    def off(self, j: int, values: np.ndarray) -> np.ndarray: ...


@dataclass(frozen=True, eq=False)
class Trial:
    """A reading to try.

    Args:
        law: the effect that it undoes.
        place: of it, as reported.
        each: True where a number of every joint was fitted for it.
    """

    law: Effect
    place: Place
    hypothesis: Hypothesis
    each: bool = False
