"""One arc: its circle, the rows set aside, which way it turns, its noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import special

from app.calibration.base.arcs import Arc
from app.calibration.base.frame import Axes
from app.calibration.base.scan import largest_shift
from app.calibration.base.sense import Sense, sense_from_angles, sense_from_order
from app.geometry.circle import AxisFit, fit_axis
from app.units import deg, from_deg, from_mm

SUSPECT = 1e-3  # family-wise chance below which a row or a step is named
_LARGEST_SHARE = 0.15  # of the rows may be set aside one by one
_WORTH_NAMING = from_mm(0.01)  # a shift below this is named by nobody
#: Angles are read off a pendant and joints have errors of their own: a gap below this is no mistake.
ANGLE_TOLERANCE = from_deg(0.5)


@dataclass(frozen=True, eq=False)
class ArcFit:
    """What one arc gave.

    Args:
        arc: as recorded.
        fit: the axis and its circle(s); its direction is as it fell out, see `axes` for the signed one.
        weights: (n,) 0 for rows set aside, else 1/sigma^2 (stated noise) or 1.
        groups: (n,) which circle a row belongs to.
        sense: which way it turns.
        outliers: line numbers set aside.
        moved_at: line number from which on the reflector sat elsewhere, or None; `moved_by` [m] how far.
        stated: True where the noise was stated.
        scale: factor on the covariance: the variance where it had to be estimated, else 1 (or more, where the
            residuals deny the stated noise).
        shared: index of the row of every sample among the arc's rows (several reflectors share one).
    """

    arc: Arc
    fit: AxisFit
    weights: np.ndarray
    groups: np.ndarray
    sense: Sense
    outliers: tuple[int, ...] = ()
    moved_at: int | None = None
    moved_by: float = 0.0
    stated: bool = False
    scale: float = 1.0

    @property
    def axes(self) -> Axes:
        """The axis with its covariance, along the positive turn."""
        raw = Axes(self.fit.point, self.fit.basis, self.fit.covariance[:4, :4] * self.scale)
        return raw.reversed_where(np.array(self.sense.sign < 0))

    @property
    def used(self) -> np.ndarray:
        """(n,) True for the rows that were fitted."""
        return self.weights > 0

    @property
    def length(self) -> float:
        """Angle the rows cover on the circle, at most a full turn [rad]."""
        return self.sense.travel

    @property
    def radius(self) -> float:
        """Radius of the circle with the most rows, the largest of equals [m]."""
        return float(self.fit.radii[self._main])

    @property
    def centre(self) -> np.ndarray:
        """(3,) [m] centre of that circle."""
        return self.fit.centres[self._main]

    @property
    def _main(self) -> int:
        return int(np.lexsort((self.fit.radii, np.bincount(self.groups, self.used)))[-1])

    @property
    def rms(self) -> float:
        """Root mean square distance of the rows fitted from their circle [m]."""
        return float(np.sqrt(np.mean(np.sum(self.fit.residuals[self.used] ** 2, axis=1))))

    @property
    def sigma_axis(self) -> float:
        """One-sigma angle between the axis found and the true one [rad]."""
        return float(np.sqrt(self.scale * (self.fit.covariance[2, 2] + self.fit.covariance[3, 3])))

    @property
    def sigma_centre(self) -> float:
        """One-sigma distance of the first circle's centre from the true one, in its plane [m]."""
        return float(np.sqrt(self.scale * (self.fit.covariance[0, 0] + self.fit.covariance[1, 1])))

    @property
    def sigma(self) -> float:
        """One-sigma noise of a coordinate that the covariance rests on [m]."""
        return float(np.sqrt(self.scale / np.mean(self.weights[self.used])))


def fit_arcs(arcs: Sequence[Arc], sigmas: Sequence[np.ndarray | None], floor: float) -> list[ArcFit]:
    """Fits every arc; sets outliers and the part after a moved reflector apart; settles sense and noise.

    Args:
        arcs: what was recorded.
        sigmas: stated noise of every point [m] of every arc, or None.
        floor: smallest noise that is believed [m].
    """
    weights = [
        np.ones(len(a)) if s is None else 1.0 / np.maximum(s, floor) ** 2
        for a, s in zip(arcs, sigmas, strict=True)
    ]
    fits = _together(arcs, weights)
    out = []
    for arc, weight, fit, sigma in zip(arcs, weights, fits, sigmas, strict=True):
        raw = ArcFit(
            arc, fit, weight, arc.reflectors, Sense(0, np.zeros(len(arc), bool)), stated=sigma is not None
        )
        clean = _set_aside(raw)
        out.append(replace(clean, sense=_sense(clean)))
    return _with_noise(out, floor)


def _together(arcs: Sequence[Arc], weights: Sequence[np.ndarray]) -> list[AxisFit]:
    """One sweep for arcs of one reflector and one length: half the time for the usual pair."""
    single = all(a.reflectors.max(initial=0) == 0 for a in arcs)
    if not single or len({len(a) for a in arcs}) != 1:
        return [fit_axis(a.points, w, a.reflectors) for a, w in zip(arcs, weights, strict=True)]
    both = fit_axis(np.stack([a.points for a in arcs]), np.stack(weights))
    return [
        AxisFit(*(getattr(both, name)[k] for name in both.__dataclass_fields__)) for k in range(len(arcs))
    ]


def _set_aside(raw: ArcFit) -> ArcFit:
    """Takes the most telling shift out, fits again, until nothing telling is left; never without saying so."""
    current = raw
    limit = int(_LARGEST_SHARE * len(raw.arc))
    while True:
        one_circle = raw.arc.reflectors.max(initial=0) == 0 and current.moved_at is None
        shift = largest_shift(current.fit, current.weights, steps=one_circle, stated=raw.stated)
        if shift is None or shift.p_value > SUSPECT or shift.size < _WORTH_NAMING:
            return current
        row = int(raw.arc.rows[shift.index])
        if shift.kind == "step":
            groups = (np.arange(len(raw.arc)) >= shift.index).astype(int)
            # Rows that only looked odd because of the step come back.
            fit = fit_axis(raw.arc.points, raw.weights, groups)
            current = replace(
                raw,
                fit=fit,
                weights=raw.weights,
                groups=groups,
                moved_at=row,
                moved_by=shift.size,
                outliers=(),
            )
            continue
        if len(current.outliers) >= max(limit, 1):
            return current
        weights = current.weights.copy()
        weights[shift.index] = 0.0
        fit = fit_axis(raw.arc.points, weights, current.groups)
        current = replace(current, fit=fit, weights=weights, outliers=(*current.outliers, row))


def _sense(found: ArcFit) -> Sense:
    fit, arc = found.fit, found.arc
    used = found.used
    groups = found.groups[used]
    size = fit.radii[groups]
    if arc.angles is None:
        part = sense_from_order(fit.azimuths[used], groups, size)
    else:
        tolerance = ANGLE_TOLERANCE + 5.0 * found.rms / max(float(fit.radii.max()), 1e-6)
        part = sense_from_angles(fit.azimuths[used], arc.angles[used], groups, size, tolerance)
    odd = np.zeros(len(arc), bool)
    odd[used] = part.odd & (
        size > 0.2 * fit.radii.max()
    )  # a place near the axis has no azimuth worth the name
    gap = None if part.gap is None else np.full(len(arc), np.nan)
    if gap is not None:
        gap[used] = part.gap
    return Sense(part.sign, odd, gap, part.phase, part.travel)


def _with_noise(found: list[ArcFit], floor: float) -> list[ArcFit]:
    """The variance behind each covariance.

    Stated noise stands unless the residuals deny it. Noise that must be estimated is shared by arcs whose
    residuals agree (they were measured by one instrument), and kept apart where they do not.
    """
    out = []
    free = [f for f in found if not f.stated and f.fit.dof > 0]
    pooled = sum(float(f.fit.sse) for f in free) / max(sum(int(f.fit.dof) for f in free), 1)
    for f in found:
        dof, sse = int(f.fit.dof), float(f.fit.sse)
        if f.stated:
            denied = dof > 0 and float(special.chdtrc(dof, sse)) < SUSPECT
            out.append(replace(f, scale=sse / dof if denied else 1.0))
        elif dof > 0:
            rest = sum(int(g.fit.dof) for g in free) - dof
            other = (sum(float(g.fit.sse) for g in free) - sse) / max(rest, 1)
            own = sse / dof
            ratio = own / other if other > 0 else np.inf
            alike = rest == 0 or min(special.fdtrc(dof, rest, ratio), special.fdtr(dof, rest, ratio)) > 0.005
            variance = pooled if alike else own
            out.append(replace(f, scale=max(variance, floor**2)))
        else:  # as many points as unknowns: nothing tells the noise
            default = default_noise(f.arc.points)
            out.append(replace(f, scale=max(float(np.mean(default**2)), floor**2)))
    return out


def default_noise(points: np.ndarray) -> np.ndarray:
    """(n,) [m] what makers state for a laser tracker: 15 um + 6 um/m of distance."""
    return 15e-6 + 6e-6 * np.linalg.norm(points, axis=-1)


def describe(found: ArcFit) -> str:
    """`axis 1 (36 rows, 120.0 degrees)`."""
    return f"axis {found.arc.axis} ({len(found.arc)} rows, {deg(found.length):.1f} degrees)"
