"""What a diagnosis says. Frozen; plain numbers and arrays; the JSON is teachframe.diagnosis/1."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from app.errors import TeachframeError

Verdict = Literal["clean", "named", "partly", "unexplained"]
NoiseSource = Literal["repeats", "stated", "resolution", "residual"]

#: Called with the share done (0..1) and what is being done; may raise Cancelled to stop the search.
Progress = Callable[[float, str], None]


class Cancelled(TeachframeError):
    """The person at the screen stopped the search."""


@dataclass(frozen=True)
class Noise:
    """One-sigma noise of one measured component, and how it is known. `unit` is mm, deg or Nm."""

    value: float
    unit: str
    source: NoiseSource


@dataclass(frozen=True)
class Quality:
    """Root mean square of what is left, on the rows fitted and on rows held out. `unit` is mm or Nm."""

    fit_rms: float
    heldout_rms: float
    unit: str


@dataclass(frozen=True)
class Parameter:
    """One number of an effect with its one-sigma uncertainty, in `unit`."""

    name: str
    value: float
    std: float
    unit: str


@dataclass(frozen=True)
class Alternative:
    """Another effect that explains the data about as well; `delta_bic` > 0 is worse than the one named."""

    effect: str
    where: Mapping[str, Any]
    delta_bic: float


@dataclass(frozen=True)
class Finding:
    """One effect that earned its place.

    Args:
        effect: its key.
        where: joint, driver, link, axis, body, row or time.
        parameters: values with uncertainty.
        visible: share (0..1) of the effect's signature that the nuisance parameters cannot imitate.
        p_value: family-wise, over the whole search.
        heldout_rms_without: held-out error of the final model with this effect taken out and the rest refitted.
        heldout_rms_with: held-out error of the final model.
        alternatives: other explanations this recording cannot rule out.
        sentence: what an operator reads.
        equation: the law.
        heldout_unit: of both held-out errors, where it is not the diagnosis's own.
        share: (0..1) of the mean square of `before`, above noise, that is lost without it, the rest as it is; NaN where
            nobody measured it. For people: the JSON has it by family.
    """

    effect: str
    where: Mapping[str, Any]
    parameters: tuple[Parameter, ...]
    visible: float
    p_value: float
    heldout_rms_without: float
    heldout_rms_with: float
    alternatives: tuple[Alternative, ...]
    sentence: str
    equation: str
    heldout_unit: str = ""
    share: float = float("nan")


@dataclass(frozen=True)
class Leftover:
    """Whether structure remains after the findings, and what it follows.

    Args:
        share: (0..1) of the mean square of `before`, above noise, that no named effect explains.
    """

    p_value: float
    where: Mapping[str, Any]
    share: float = 0.0


@dataclass(frozen=True)
class FamilyShare:
    """One line of the error budget.

    Args:
        family: its key; `STATIC_FAMILIES` or `MOTION_FAMILIES` give the order.
        share: (0..1) of the mean square of `before`, above noise, that is lost when the family is taken out of the
            final model, the other families kept as they are and base, tool and touched points fitted anew.
        heldout_rms_after: held-out error of a model with this family and all before it in the order, refitted.
        members: indices of the findings that belong to it.
    """

    family: str
    share: float
    heldout_rms_after: float
    members: tuple[int, ...] = ()


#: Family of what has no name, the last line of every error budget.
UNNAMED = "unnamed"
#: Families of the error budget, in their order.
STATIC_FAMILIES = (
    "conventions", "zeros", "geometry", "elasticity", "gears", "play", "couplings", "load", "instrument", "events",
    UNNAMED,
)  # fmt: skip
MOTION_FAMILIES = (
    "conventions", "mounting", "inertials", "friction", "rotors", "load", "drive", "timing", "couplings", "events",
    UNNAMED,
)  # fmt: skip


@dataclass(frozen=True)
class Judged:
    """What a model learnt elsewhere makes of this recording: nothing but what a set-up leaves open is fitted.

    Args:
        source: the recording it was learnt from.
        steps: what is in the simulation -> the error, the bare description first.
    """

    source: str
    steps: Mapping[str, Quality]


@dataclass(frozen=True, eq=False)
class Evidence:
    """What pictures are drawn from; not part of the JSON.

    Args:
        rows: (m,) line number in the file of each sample; of long logs a thinned choice may stand here.
        measured: (m, k) measured values: points in the instrument's (touch: the base) frame [m], or torques [Nm].
        before: (m, k) residual, measured minus predicted by the bare description with its nuisance fitted.
        after: (m, k) residual with the findings in the model.
        components: k labels, such as "x", "y", "z" or "joint 3".
        unit: unit of measured and residuals ("m" or "Nm").
        q: (m, n) joint positions as recorded [rad or m].
        drivers: label with unit, "gravity torque of joint 2 [Nm]" -> (m,) in that unit, what residuals can be
            plotted against.
        points_predicted_before: (m, 3) tool point in base, bare description [m]; static only.
        points_predicted_after: (m, 3) with the findings [m]; static only.
        points_measured: (m, 3) measured tool point brought into base [m]; static only.
        flange_tool: (3,) fitted tool point in the flange [m]; static only.
        kept: (m,) False for rows set aside as outliers.
        t: (m,) time of each sample [s]; None where the recording has none.
        vectors_before: (m, 3) residual of the first point in base, from points_predicted_before [m]; static only.
        vectors_after: (m, 3) likewise with the findings in the model [m].
        parts: family of the error budget -> (m, k) what it adds to the prediction of each component, in `unit`;
            `before` without all of them is `after`, where the engine says them.
    """

    rows: np.ndarray
    measured: np.ndarray
    before: np.ndarray
    after: np.ndarray
    components: tuple[str, ...]
    unit: str
    q: np.ndarray
    drivers: Mapping[str, np.ndarray]
    kept: np.ndarray
    points_predicted_before: np.ndarray | None = None
    points_predicted_after: np.ndarray | None = None
    points_measured: np.ndarray | None = None
    flange_tool: np.ndarray | None = None
    t: np.ndarray | None = None
    vectors_before: np.ndarray | None = None
    vectors_after: np.ndarray | None = None
    parts: Mapping[str, np.ndarray] = field(default_factory=dict)

    @property
    def seconds(self) -> np.ndarray | None:
        """(m,) time [s] of each sample, from wherever it is known."""
        if self.t is not None:
            return self.t
        return next((np.asarray(v, float) for k, v in self.drivers.items() if k == "time [s]"), None)


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """Everything a diagnosis says of one recording.

    Args:
        families: the error budget, in the order of the kind's families; those without a share are left out.
        notes: warnings for a person: rows doubled, masses assumed, noise unknown, a filter's choice.
        model: the found effects as data, see model.py.
        judged: a model that was given, on this recording; None where none was.
        next_poses: joint positions [rad or m] that would best separate the two best explanations.
    """

    file: str
    kind: str
    robot: str
    samples: int
    verdict: Verdict
    noise: Noise
    before: Quality
    after: Quality
    findings: tuple[Finding, ...]
    outliers: tuple[int, ...]
    leftover: Leftover
    next_poses: tuple[tuple[float, ...], ...]
    seconds: float
    families: tuple[FamilyShare, ...] = ()
    notes: tuple[str, ...] = ()
    model: Mapping[str, Any] = field(default_factory=dict)
    judged: Judged | None = None
    evidence: Evidence | None = field(default=None, repr=False)

    def to_json(self) -> dict[str, Any]:
        """The contract's object: only JSON types, no NaN (null instead)."""
        out: dict[str, Any] = {
            "format": "teachframe.diagnosis/1",
            "file": self.file,
            "kind": self.kind,
            "robot": self.robot,
            "samples": self.samples,
            "verdict": self.verdict,
            "noise": _plain(self.noise),
            "before": _plain(self.before),
            "after": _plain(self.after),
            "findings": [_finding(f) for f in self.findings],
            "families": _plain(self.families),
            "outliers": list(self.outliers),
            "leftover": _plain(self.leftover),
            "next_poses": [list(q) for q in self.next_poses],
            "seconds": self.seconds,
            "notes": list(self.notes),
        }
        if self.judged is not None:
            out["judged"] = self.judged
        return _plain(out)


def _finding(finding: Finding) -> dict[str, Any]:
    """The unit of its errors is only said where it is not that of `before` and `after`; shares are said by family."""
    out = _plain(finding)
    if not finding.heldout_unit:
        del out["heldout_unit"]
    del out["share"]
    return out


def _plain(value: Any) -> Any:
    """JSON types only."""
    if hasattr(value, "__dataclass_fields__"):
        return {name: _plain(getattr(value, name)) for name in value.__dataclass_fields__}
    if isinstance(value, str):
        return str(value)  # a remark that remembers its phrase is its sentence here
    if isinstance(value, Mapping):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(v) for v in value]
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value
