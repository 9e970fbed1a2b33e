"""What a tool calibration says. Frozen; metres and radians."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from app.estimation import reach
from app.geometry import Pose
from app.phrases import Phrase
from app.units import mm


@dataclass(frozen=True)
class Warning_:
    """Something the operator should know.

    Args:
        code: the check's key, for programs.
        message: what was seen, with its figures.
        advice: what to do next.
        severe: True where the result should not be accepted as it stands.
        note: True where nothing is wrong with the result: it is only told.
        phrases: message and advice before they were put into words; () where they speak English only.
    """

    code: str
    message: str
    advice: str = ""
    severe: bool = False
    note: bool = field(default=False, kw_only=True)
    phrases: tuple[Phrase, ...] = field(default=(), repr=False, compare=False)

    def __str__(self) -> str:
        return f"{self.message}; {self.advice}" if self.advice else self.message

    def said(self, language: str) -> str:
        """Message and advice in a language."""
        if not self.phrases:
            return str(self)
        seen, todo = self.phrases
        return seen.texts.text("warning.said", language, seen=seen, todo=todo)


@dataclass(frozen=True)
class AxisCone:
    """How well one taught axis of the tool is known.

    Args:
        axis: "x", "y" or "z".
        stroke: how far the tip was moved to show it [m]; 0 where no stroke shows it.
        sigma: one-sigma angle in any plane that holds the axis [rad].
        half_angle: half angle of the cone that holds the true axis in 95 of 100 cases [rad].
    """

    axis: str
    stroke: float
    sigma: float
    half_angle: float


@dataclass(frozen=True, eq=False)
class ToolCalibration:
    """A tool frame with everything that is known about its quality.

    Args:
        T_flange_tool: the tool frame in the flange.
        p_base: (3,) the touched point in base [m].
        method: the estimator's key, or the mode's where no touches were fitted.
        orientation: how the axes were found.
        residual_vectors: (n, 3) tip of touch i minus the touched point, in base [m].
        delta: eq. (10) of Xiong 2012: norm of all neighbouring differences of the tip [m].
        covariance: (3, 3) of the tool point in the flange [m^2].
        sigma: estimated one-sigma noise of one touch on one axis, sqrt(SSE / dof) [m].
        dof: degrees of freedom behind sigma.
        condition: largest over smallest singular value of the equations of the tool point.
        rank: directions of the tool point that are determined.
        rows: (n,) where the touches stand: line in the file, or number of the capture.
        gains: (n, 3, 3) how far the tool point moves for an error of each tip.
        weights: (n,) 0..1 what each touch counted; all 1 unless the robust estimator was asked for.
        cones: uncertainty of the taught axes.
        warnings: what the checks found.
    """

    T_flange_tool: Pose
    p_base: np.ndarray
    method: str
    orientation: str
    residual_vectors: np.ndarray
    delta: float
    covariance: np.ndarray
    sigma: float
    dof: int
    condition: float
    rank: int
    rows: tuple[int, ...] = ()
    gains: np.ndarray = field(default_factory=lambda: np.zeros((0, 3, 3)))
    weights: np.ndarray = field(default_factory=lambda: np.ones(0))
    cones: tuple[AxisCone, ...] = ()
    warnings: tuple[Warning_, ...] = ()

    def __post_init__(self):
        for name in ("p_base", "residual_vectors", "covariance", "gains", "weights"):
            array = np.array(getattr(self, name), float)
            array.flags.writeable = False
            object.__setattr__(self, name, array)

    @property
    def tool_point(self) -> np.ndarray:
        """(3,) the tool point in the flange [m]."""
        return self.T_flange_tool.position

    @property
    def per_point(self) -> np.ndarray:
        """(n,) distance of each touch's tip from the touched point [m]."""
        return np.linalg.norm(self.residual_vectors, axis=1)

    @property
    def mean(self) -> float:
        """Mean distance to the touched point, the figure makers show [m]."""
        return float(self.per_point.mean()) if len(self.residual_vectors) else 0.0

    @property
    def max(self) -> float:
        """Largest distance to the touched point [m]."""
        return float(self.per_point.max()) if len(self.residual_vectors) else 0.0

    @property
    def rms(self) -> float:
        """Root mean square distance to the touched point [m]."""
        return float(np.sqrt(np.mean(self.per_point**2))) if len(self.residual_vectors) else 0.0

    @property
    def worst(self) -> int:
        """Index of the touch that lies farthest off."""
        return int(np.argmax(self.per_point)) if len(self.residual_vectors) else 0

    @property
    def sigma_tool(self) -> np.ndarray:
        """(3,) predicted one-sigma uncertainty of the tool point along the flange's axes [m]."""
        return np.sqrt(np.maximum(np.diag(self.covariance), 0.0))

    def with_warnings(self, *more: Warning_) -> ToolCalibration:
        """The same result with further warnings behind those it has."""
        return replace(self, warnings=(*self.warnings, *more))

    def summary(self) -> str:
        """A few lines for a person, in millimetres."""
        p, s = mm(self.tool_point), mm(self.sigma_tool * reach(self.dof, dimensions=1))
        lines = [
            "tool point in the flange [mm], ± 95%: "
            + ", ".join(f"{axis} {v:.3f} ± {e:.3f}" for axis, v, e in zip("xyz", p, s, strict=True)),
        ]
        if len(self.residual_vectors):
            lines.append(
                f"distance to the touched point [mm]: mean {mm(self.mean):.3f}, max {mm(self.max):.3f} "
                f"(touch {self.worst + 1}), rms {mm(self.rms):.3f}"
            )
            lines.append(
                f"delta (eq. 10) {mm(self.delta):.3f} mm, noise of a touch {mm(self.sigma):.3f} mm an axis, "
                f"condition {self.condition:.2f}, rank {self.rank}"
            )
        lines += [f"{w.code}: {w}" for w in self.warnings]
        return "\n".join(lines)
