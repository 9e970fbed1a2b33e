"""Base frame from axis-1 and axis-2 arcs of a laser tracker; two files: the two-robot relation."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import tyro

from app.cli.arguments import RobotArguments


@dataclass
class Command:
    """Base frame from axis-1 and axis-2 arcs of a laser tracker; two files: the two-robot relation.

    Reads files of kind `arcs`, exports of SpatialAnalyzer, Leica and API trackers whose point names say axis and
    angle (A1_-90, A2_15.5), and recordings of kind `tracker`: with one axis moving at a time they hold arcs of
    every axis, else the base is fitted to the poses by the robot's description.
    """

    file: tyro.conf.Positional[Path]
    """Arcs of the (first) robot."""

    file2: tyro.conf.Positional[Path | None] = None
    """Arcs of the second robot, recorded with the tracker in the same place."""

    arm: tyro.conf.OmitArgPrefixes[RobotArguments] = field(default_factory=RobotArguments)
    """The robot: its description gives the step to the maker's base frame."""

    axis: tuple[str, ...] = ()
    """For exports whose names do not say it: AXIS=PATTERN, such as 1=ROB1_J1_* 2=ROB1_J2_*."""

    unit: Literal["mm", "m", "in"] | None = None
    """Unit of an export that does not say its own."""

    joints: Path | None = None
    """For a list of tracked points: the joint angles of the same poses, row by row."""

    at: tuple[float, float, float] | None = None
    """Where both tools meet, mm in base 1; default half-way between the work spaces."""

    json: bool = False
    """One JSON object instead of the table."""

    language: Literal["en", "zh"] = "en"
    """Of the table."""

    def run(self) -> int:
        import msgspec

        from app.calibration.base.run import run_base

        result = run_base(
            [self.file] if self.file2 is None else [self.file, self.file2],
            robot=self.arm.address,
            patterns=self.axis,
            meeting_mm=self.at,
            unit=self.unit,
            joints=self.joints,
        )
        print(msgspec.json.encode(result.to_json()).decode() if self.json else result.to_text(self.language))
        return 0
