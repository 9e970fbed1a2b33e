"""What a search leaves: the plain fit before, the plan with its findings, the rows set aside."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.static.fit import Fitted
from app.diagnosis.static.gross import Rewritten
from app.diagnosis.static.plan import Plan
from app.diagnosis.static.search import Found


@dataclass(frozen=True, eq=False)
class Outcome:
    """Everything the words are made of.

    Args:
        written: the recording, wrong conventions undone.
        before: base, tool and targets only.
        plan: the findings.
        outliers: (m,) True for rows set aside.
    """

    written: Rewritten
    before: Fitted
    plan: Plan
    outliers: np.ndarray

    @property
    def found(self) -> Found:
        """The terms and their p."""
        return self.plan.found
