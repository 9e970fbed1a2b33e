"""What a recording was described as: the exact model, the problem linearised there, and what is in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.regression.evidence import Evidence, Posterior, Selection

if TYPE_CHECKING:
    from app.diagnosis.models.kinematic.candidates import Library
    from app.diagnosis.models.kinematic.library import Linear
    from app.diagnosis.models.kinematic.state import State


@dataclass(eq=False)
class Description:
    """A fitted description.

    Args:
        plain: base, tool and touched points alone, nothing else.
        state: the exact model.
        linear: the problem linearised there.
        evidence: of its groups.
        selection: groups that are in, with their widths.
        posterior: weights in nominal sizes, marginal in their levels.
        dense: True where families describe the arm.
        rows: (m,) robust weight of each row.
        shared: number of a candidate -> weights and covariance where all levels share alike; None on a sound
            description.
        calibrated: the same with all calibration beside what was found, where that is likelier or something has no
            name; it is what is saved, for it holds elsewhere too. None where the description is the model.
    """

    plain: State
    state: State
    linear: Linear
    evidence: Evidence
    selection: Selection
    posterior: Posterior
    dense: bool
    rows: np.ndarray
    shared: dict[int, tuple[np.ndarray, np.ndarray]] | None = None
    calibrated: Description | None = None

    @property
    def library(self) -> Library:
        return self.linear.library

    def numbers(self) -> list[int]:
        """Candidates that are in, alone or as members of a family."""
        inside: dict[int, None] = {}
        for g in self.selection:
            inside.update(dict.fromkeys(self.linear.members[g]))
        return list(inside)

    def precisions(self) -> dict[int, float]:
        """Candidate that is in -> prior precision of its weights [nominal sizes]: its own or its family's, the less."""
        out: dict[int, float] = {}
        for g, gamma in self.selection.items():
            for number in self.linear.members[g]:
                out[number] = min(out.get(number, np.inf), 1.0 / gamma)
        return out

    def response(self) -> np.ndarray:
        """(N,) whitened: what base, tool and touched points leave, the terms of the state put back."""
        linear, out = self.linear, self.linear.state.white.copy()
        for term in linear.state.terms:
            out += term.effect.columns(linear.sensitivity, term.place).reshape(len(out), -1) @ term.values
        return out
