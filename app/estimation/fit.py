"""The result of a fit."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Fit:
    """Parameters with their uncertainty, and what the fit left over.

    Args:
        names: one name a parameter.
        units: one SI unit a parameter.
        values: (p,).
        covariance: (p, p); infinite variance where a parameter is not determined.
        residuals: (m,) measured minus predicted, in the unit of the measurement (not whitened).
        dof: degrees of freedom left, m - rank.
        sigma: one-sigma noise of one residual that the covariance was scaled by.
        sigma_source: "stated" where the noise was given, "residual" where it was estimated from the fit.
        rank: parameters (directions) that are determined.
        condition: largest over smallest singular value of the scaled Jacobian.
        converged: False where the iteration ran out or got stuck; `message` says which.
        at_bound: names of parameters that ended on a bound.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    values: np.ndarray
    covariance: np.ndarray
    residuals: np.ndarray
    dof: int
    sigma: float
    sigma_source: str
    rank: int
    condition: float
    converged: bool = True
    message: str = ""
    iterations: int = 0
    at_bound: tuple[str, ...] = field(default=())

    def __post_init__(self):
        for name in ("values", "covariance", "residuals"):
            array = np.array(getattr(self, name), float)
            array.flags.writeable = False
            object.__setattr__(self, name, array)

    @property
    def standard_errors(self) -> np.ndarray:
        """(p,) one-sigma, in the parameters' units."""
        return np.sqrt(np.maximum(np.diag(self.covariance), 0.0))

    @property
    def rms(self) -> float:
        """Root mean square of the residuals."""
        return float(np.sqrt(np.mean(self.residuals**2))) if self.residuals.size else 0.0

    @property
    def sse(self) -> float:
        """Sum of squared residuals."""
        return float(self.residuals @ self.residuals)

    def __getitem__(self, name: str) -> float:
        return float(self.values[self.names.index(name)])

    def summary(self) -> str:
        """A table for a person: one row a parameter, then what the fit left over."""
        width = max([len(n) for n in self.names] + [9])
        lines = [f"{'parameter':<{width}}  {'value':>14}  {'std error':>12}  unit"]
        for name, value, error, unit in zip(
            self.names, self.values, self.standard_errors, self.units, strict=True
        ):
            mark = "  at its bound" if name in self.at_bound else ""
            lines.append(f"{name:<{width}}  {value:>14.6g}  {error:>12.3g}  {unit}{mark}")
        lines.append(
            f"rms {self.rms:.4g}, sigma {self.sigma:.4g} ({self.sigma_source}), dof {self.dof}, "
            f"rank {self.rank} of {len(self.names)}, condition {self.condition:.3g}"
        )
        if not self.converged:
            lines.append(f"NOT CONVERGED: {self.message}")
        return "\n".join(lines)
