"""Arguments that several commands have: which robot, which part of it, and how to read what a file leaves open."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import tyro

if TYPE_CHECKING:
    from app.recordings.options import ReadOptions


@dataclass
class RobotArguments:
    robot: Annotated[str | None, tyro.conf.arg(metavar="NAME|FILE")] = None
    """The robot's description: a name, a URDF, a xacro file, a DH table in CSV; without it the one the file names."""

    flange: Annotated[str | None, tyro.conf.arg(metavar="LINK")] = None
    """The link tools are bolted to; without it tool0, flange, an ee-link or the last one: the output names it."""

    chain: Annotated[str | None, tyro.conf.arg(metavar="BASE..TIP")] = None
    """The arm within a description of several: its first and its last link."""

    calibration: Annotated[str | None, tyro.conf.arg(metavar="FILE")] = None
    """Universal Robots' calibration of this one arm: calibration.conf, or the YAML of ur_calibration."""

    @property
    def choices(self) -> tuple[str | None, str | None, str | None]:
        """Flange, chain and calibration as they were said."""
        return self.flange, self.chain, self.calibration

    @property
    def address(self) -> str | None:
        """All of it in one text; None where nothing was said."""
        from app.kinematics.description.address import address_of

        return address_of(self.robot, *self.choices)


@dataclass
class ReadingArguments:
    topic: Annotated[str | None, tyro.conf.arg(metavar="NAME")] = None
    """Of a bag: the topic of joint states that is meant."""

    prefix: Annotated[str | None, tyro.conf.arg(metavar="TEXT")] = None
    """Of a bag: what stands before the joints' names, such as left_."""

    effort: Literal["Nm", "A"] | None = None
    """What the efforts of a joint state are: torques, or motor currents."""

    drive_gain: Annotated[tuple[float, ...], tyro.conf.arg(metavar="Nm/A...")] = ()
    """Torque per ampere, with --effort A: one for all joints, or one each."""

    map: Annotated[str | None, tyro.conf.arg(metavar="QUANTITY=NAME,...")] = None
    """Names in a file that has its own (MATLAB, HDF5, Parquet): q=positions:deg,tau=torques,t=time:ms. In a bag
    points=TOPIC reads tracked points."""

    joints: Annotated[Path | None, tyro.conf.arg(metavar="FILE")] = None
    """For a list of tracked points: the joint angles of the same poses, row by row."""

    unit: Literal["mm", "m", "in"] | None = None
    """Unit of a point list that does not say its own."""

    @property
    def options(self) -> ReadOptions:
        """The same, as the readers take it."""
        from app.recordings.options import ReadOptions, parse_mapping

        return ReadOptions(
            topic=self.topic,
            prefix=self.prefix,
            effort=self.effort,
            drive_gain=self.drive_gain,
            mapping=parse_mapping(self.map),
            joints=self.joints,
            unit=self.unit,
        )
