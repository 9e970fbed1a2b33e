"""Writes what was found as a simulator reads it; lists what the target cannot carry."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

import tyro

from app.cli.arguments import RobotArguments


@dataclass
class Command:
    """Writes what was found as a simulator reads it; lists what the target cannot carry, with its size.

    MODEL.json comes from `teachframe diagnose --save-model`. Masses, friction, rotor inertia, springs, load, mounting,
    geometry, delay and torque factors go where the target has a place for them.
    """

    model: Annotated[Path, tyro.conf.Positional, tyro.conf.arg(metavar="MODEL.json")]
    """The saved model."""
    out: Annotated[Path, tyro.conf.Positional]
    """The file to write."""
    to: Literal["urdf", "mjcf", "sdf", "usd"]
    """The simulator's format."""
    arm: tyro.conf.OmitArgPrefixes[RobotArguments] = field(default_factory=RobotArguments)
    """The robot; without it the one that the model names."""
    json: bool = False
    """What was written and what was left out as one JSON object."""

    def run(self) -> int:
        import msgspec

        from app.diagnosis.export import export_model
        from app.diagnosis.model import load_model
        from app.files import check_writable, write_text
        from app.kinematics import load_robot
        from app.kinematics.description.address import parse_address
        from app.kinematics.named import robot_of_file

        check_writable(self.out)
        model = load_model(self.model)
        if self.arm.robot is None:
            robot = robot_of_file(str(parse_address(model.robot).but(*self.arm.choices)), self.model)
        else:
            robot = load_robot(str(self.arm.address))
        exported = export_model(robot, model, self.to)
        write_text(self.out, exported.text)
        if self.json:
            left = [{"what": e.what, "size": e.size, "why": e.why} for e in exported.left]
            said = {
                "file": str(self.out),
                "version": exported.version,
                "flange": robot.flange,
                "not_carried": left,
            }
            print(msgspec.json.encode(said).decode())
            return 0
        print(f"{self.out}: {exported.version}")
        print(f"{robot.name}: {robot.joint_count} joints from {robot.base} to its flange {robot.flange}")
        for entry in exported.left:
            print(f"not carried: {entry}")
        if not exported.left:
            print("everything that was found is in it", file=sys.stderr)
        return 0
