"""What a base calibration says. Frozen; metres and radians."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.arcs import Arcs
from app.calibration.result import Warning_
from app.geometry import Pose
from app.phrases import Phrase


@dataclass(frozen=True, eq=False)
class MakerFrame:
    """The base frame of the robot's description, a fixed step from the one found.

    Args:
        robot: the description's name.
        T_base_maker: the step: the maker's frame in the patent's.
        T_tracker_maker: where it stands.
        offset_nominal: distance of axis 1 and axis 2 by the description [m], signed along X.
        angle_nominal: angle between them [rad].
        height_nominal: of axis 2 above the maker's origin [m].
    """

    robot: str
    T_base_maker: Pose
    T_tracker_maker: Pose
    offset_nominal: float
    angle_nominal: float
    height_nominal: float


@dataclass(frozen=True, eq=False)
class ZeroPlace:
    """Joint 1's angle while axis 2 was turned, found from where the two circles meet.

    Args:
        angle: [rad]; 0 when the procedure was followed.
        sigma: [rad].
        miss: [m] how far the places at angle zero of axis 2 are from the circle of axis 1.
        known: True where the miss is small enough that the angle means something.
        stated: True where the file said it.
    """

    angle: float
    sigma: float
    miss: float
    known: bool
    stated: bool = False


@dataclass(frozen=True, eq=False)
class BaseCalibration:
    """A robot's base in the tracker, and how well it is known.

    Args:
        source: what was recorded.
        T_tracker_base: the patent's frame.
        covariance: (6, 6) of displacement [m] and rotation [rad] in that frame's own axes.
        first, second: the arcs of axis 1 and axis 2.
        offset, offset_sigma: length of the common perpendicular, towards +X positive [m].
        angle, angle_sigma: between axis 1 and axis 2 [rad].
        axis2_along_y: direction of axis 2 on Y: near +1, or a direction is wrong.
        towards: (3,) the point X looks at, in the tracker [m].
        zero: joint 1 while axis 2 was turned, where both arcs carry angles.
        maker: the maker's frame, where the description is known.
        others: arcs of further axes.
        warnings: what the checks found, the severe ones first.
        notes: what a person should know and no check can settle.
    """

    source: Arcs
    T_tracker_base: Pose
    covariance: np.ndarray
    first: ArcFit
    second: ArcFit
    offset: float
    offset_sigma: float
    angle: float
    angle_sigma: float
    axis2_along_y: float
    towards: np.ndarray
    zero: ZeroPlace | None = None
    maker: MakerFrame | None = None
    others: tuple[ArcFit, ...] = ()
    warnings: tuple[Warning_, ...] = ()
    notes: tuple[Phrase, ...] = ()

    def __post_init__(self):
        for name in ("covariance", "towards"):
            array = np.array(getattr(self, name), float)
            array.flags.writeable = False
            object.__setattr__(self, name, array)

    @property
    def arcs(self) -> tuple[ArcFit, ...]:
        """Axis 1, axis 2, then the others."""
        return (self.first, self.second, *self.others)

    @property
    def sigma_position(self) -> np.ndarray:
        """(3,) [m] one-sigma of the origin along the frame's axes."""
        return np.sqrt(np.diag(self.covariance)[:3])

    @property
    def sigma_rotation(self) -> np.ndarray:
        """(3,) [rad] one-sigma of the turn about the frame's axes."""
        return np.sqrt(np.diag(self.covariance)[3:])
