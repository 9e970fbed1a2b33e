"""A laser tracker that sees what a real one would: noise, range, its own limits, a broken beam, a turned reflector."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from app.geometry import Pose
from app.units import from_deg, from_mm, from_um

Reason = Literal["seen", "range", "elevation", "turned_away", "occluded"]

#: What the operator reads.
SENTENCES: dict[str, str] = {
    "seen": "the beam is on the reflector",
    "range": "the reflector is out of the tracker's range",
    "elevation": "the reflector is above or below what the tracker's head can reach",
    "turned_away": "the reflector looks away from the tracker",
    "occluded": "an arm breaks the beam",
}


@dataclass(frozen=True, eq=False)
class Capsule:
    """A rod with round ends, what arms are made of here.

    Args:
        start, end: (3,) [m] in the world.
        radius: [m].
        name: whose part it is.
    """

    start: np.ndarray
    end: np.ndarray
    radius: float
    name: str = ""


@dataclass(frozen=True)
class Sight:
    """One try to measure.

    Args:
        reason: `seen`, or why not.
        point: (3,) [m] in the tracker's frame with noise, None where nothing was seen.
        sigma: one-sigma noise of a coordinate there [m].
        by: what breaks the beam.
    """

    reason: Reason
    point: np.ndarray | None
    sigma: float
    by: str = ""

    @property
    def seen(self) -> bool:
        return self.point is not None

    @property
    def sentence(self) -> str:
        return SENTENCES[self.reason] + (f" ({self.by})" if self.by else "")


@dataclass(frozen=True, eq=False)
class LaserTracker:
    """The instrument.

    Args:
        T_world_tracker: where it stands; its beam leaves from its origin.
        noise: one-sigma of a coordinate at the tracker [m], and `noise_per_m` what every metre adds.
        nearest, farthest: range [m].
        lowest, highest: elevation of the beam [rad].
        acceptance: half angle within which a reflector throws the beam back [rad].
    """

    T_world_tracker: Pose
    noise: float = from_um(15.0)
    noise_per_m: float = 6e-6
    nearest: float = 0.5
    farthest: float = 40.0
    lowest: float = from_deg(-60.0)
    highest: float = from_deg(77.0)
    acceptance: float = from_deg(75.0)

    def sigma(self, distance: float) -> float:
        """One-sigma of a coordinate at this distance [m]."""
        return self.noise + self.noise_per_m * distance

    def look(
        self,
        p_world: np.ndarray,
        facing: np.ndarray | None,
        obstacles: tuple[Capsule, ...],
        rng: np.random.Generator | None,
    ) -> Sight:
        """Tries to measure a reflector.

        Args:
            p_world: (3,) [m] its centre.
            facing: (3,) unit, where it looks; None for one that looks everywhere (a nest on the floor).
            obstacles: what may stand in the beam.
            rng: draws the noise; None gives the true place (for planning).
        """
        local = self.T_world_tracker.inverse().apply(p_world)
        distance = float(np.linalg.norm(local))
        sigma = self.sigma(distance)
        if not self.nearest <= distance <= self.farthest:
            return Sight("range", None, sigma)
        if not self.lowest <= np.arcsin(local[2] / distance) <= self.highest:
            return Sight("elevation", None, sigma)
        origin = self.T_world_tracker.position
        if facing is not None:
            back = (origin - p_world) / distance
            if float(back @ facing) < np.cos(self.acceptance):
                return Sight("turned_away", None, sigma)
        end = p_world + (origin - p_world) * (_CLEAR / distance)  # the nest itself does not count
        for capsule in obstacles:
            if segment_distance(origin, end, capsule.start, capsule.end) < capsule.radius:
                return Sight("occluded", None, sigma, capsule.name)
        noise = np.zeros(3) if rng is None else rng.normal(0.0, sigma, 3)
        return Sight("seen", local + noise, sigma)


_CLEAR = from_mm(30.0)


def segment_distance(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> float:
    """Shortest distance between segments a-b and c-d [m]; (3,) each.

    Source: Ericson (2005), Real-Time Collision Detection, section 5.1.9.
    """
    u, v, w = b - a, d - c, a - c
    uu, uv, vv, uw, vw = u @ u, u @ v, v @ v, u @ w, v @ w
    denominator = uu * vv - uv * uv
    s = (
        float(np.clip((uv * vw - vv * uw) / denominator, 0, 1))
        if denominator > 1e-12 * max(uu * vv, 1e-30)
        else 0.0
    )
    t = float(np.clip((uv * s + vw) / vv, 0, 1)) if vv > 0 else 0.0
    s = float(np.clip((uv * t - uw) / uu, 0, 1)) if uu > 0 else 0.0
    return float(np.linalg.norm(w + s * u - t * v))
