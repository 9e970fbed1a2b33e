"""What descriptions of rigid bodies have words for: an effect says in these what it changes, a format writes its own.

SI units; joints and links count from 1.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from app.kinematics.dynamics import point_mass

#: Mass [kg], first moment [kg m] and inertia [kg m^2] of a body about its frame, as saved and in this order.
INERTIAL = ("mass", "mx", "my", "mz", "ixx", "ixy", "iyy", "ixz", "iyz", "izz")


@dataclass(frozen=True, eq=False)
class Placed:
    """A joint stands elsewhere: its placement is followed by a shift and a turn.

    Args:
        joint: number; one past the last is the flange.
        shift: (3,) [m], turn: (3,) [rad] rotation vector, both in the placement's own frame.
    """

    joint: int
    shift: np.ndarray | None = None
    turn: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class Body:
    """A body is fixed to a link.

    Args:
        mass: [kg].
        centre: (3,) [m] in the link's frame.
        own: (6,) inertia about its centre, xx xy yy xz yz zz [kg m^2].
        link: number; None for the flange.
    """

    mass: float
    centre: np.ndarray
    own: np.ndarray
    link: int | None = None

    @property
    def inertial(self) -> np.ndarray:
        """(10,) about the frame of the link."""
        out = point_mass(self.mass, self.centre)
        out[4:] += self.own
        return out


@dataclass(frozen=True, eq=False)
class Masses:
    """The masses of a link are others by change (10,), see INERTIAL."""

    link: int
    change: np.ndarray


@dataclass(frozen=True, eq=False)
class InJoint:
    """What acts in a joint is more by these.

    Args:
        joint: number.
        more: damping [Nm s/rad], damping2 [Nm s^2/rad^2], friction [Nm], armature [kg m^2], stiffness [Nm/rad],
            offset [Nm] -> how much.
        turns_over: speed [rad/s] over which its dry friction changes sign; 0 where that is not known.
        turns_on: way [rad] on which it does; 0 where it follows the speed alone.
    """

    joint: int
    more: Mapping[str, float]
    turns_over: float = 0.0
    turns_on: float = 0.0


@dataclass(frozen=True, eq=False)
class Gravity:
    """Gravity is (3,) [m/s^2] in base."""

    vector: np.ndarray


@dataclass(frozen=True)
class Late:
    """Torques act, or are recorded, so much later [s]."""

    seconds: float


@dataclass(frozen=True)
class Gain:
    """Recorded torques are so many times the true ones.

    Args:
        joint: number; None for all.
    """

    factor: float
    joint: int | None = None


Change = Placed | Body | Masses | InJoint | Gravity | Late | Gain


def only(parameters: Mapping[str, float]) -> float:
    """The first of an effect's saved values, of those that have but one; 0 where there is none."""
    return float(next(iter(parameters.values()), 0.0))


def body(where: Mapping[str, object], parameters: Mapping[str, float]) -> tuple[Body, ...]:
    """A load as saved: its mass, its centre, its inertia about that; none where no mass is said."""
    if "mass" not in parameters:
        return ()
    link = where.get("link")
    return (
        Body(
            parameters["mass"],
            np.array([parameters.get(f"com_{c}", 0.0) for c in "xyz"]),
            np.array([parameters.get(f"fixed_{name}", 0.0) for name in INERTIAL[4:]]),
            int(str(link)) if link is not None else None,
        ),
    )
