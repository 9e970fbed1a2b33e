"""What a person says of a file that does not say everything itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from app.errors import InputError

#: What the effort of a joint state may be.
EFFORTS = ("Nm", "A")


@dataclass(frozen=True)
class ReadOptions:
    """How to read files that leave something open; every field may be left out.

    Args:
        topic: of a bag, the topic whose joint states are meant.
        prefix: of joint names in a bag or log, as `left_`.
        effort: unit of a joint state's effort: "Nm" or "A" (motor currents).
        drive_gain: torque per current [Nm/A], one for all joints or one each.
        mapping: quantity -> name in the file, as q -> /robot/positions, with a unit behind it where it needs one.
        joints: a file of joint angles, one row a pose, for a list of tracked points of the same poses.
        unit: of a list of points that does not say its own: `mm`, `m` or `in`.
        joint_names: the robot's joints, looked for by name.
        slides: which of them slide.
    """

    topic: str | None = None
    prefix: str | None = None
    effort: str | None = None
    drive_gain: tuple[float, ...] = ()
    mapping: Mapping[str, str] = field(default_factory=dict)
    joints: Path | None = None
    unit: str | None = None
    joint_names: tuple[str, ...] = ()
    slides: tuple[bool, ...] = ()

    def __post_init__(self):
        if self.effort is not None and self.effort not in EFFORTS:
            raise InputError(f"--effort {self.effort!r}", expected="Nm or A")
        gains = np.array(self.drive_gain, float)
        if len(gains) and (not np.isfinite(gains).all() or np.any(gains == 0)):
            raise InputError("--drive-gain with a value that is 0 or no number", expected="Nm per ampere")


def parse_mapping(text: str | None) -> dict[str, str]:
    """`q=/robot/q,tau=effort:Nm` as quantity -> name.

    Raises:
        InputError: a part without `=`.
    """
    found: dict[str, str] = {}
    for part in filter(None, (text or "").split(",")):
        quantity, mark, name = part.partition("=")
        if not mark or not quantity.strip() or not name.strip():
            raise InputError(
                f"--map {part[:60]!r}", expected="QUANTITY=NAME, such as q=positions,tau=torques"
            )
        found[quantity.strip()] = name.strip()
    return found
