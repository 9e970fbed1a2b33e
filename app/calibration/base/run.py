"""Files -> result, as the command and the pendant ask for it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from app.calibration.base import report
from app.calibration.base.arcs import Arcs, read_arcs
from app.calibration.base.relation import Relation, relate
from app.calibration.base.result import BaseCalibration
from app.calibration.base.solve import solve_base
from app.calibration.result import Warning_
from app.errors import DegenerateGeometryError, InputError
from app.kinematics import RobotModel, load_robot
from app.recordings import read_table
from app.units import from_mm


@dataclass(frozen=True, eq=False)
class BaseResult:
    """One robot, or two with their relation."""

    bases: tuple[BaseCalibration, ...]
    relation: Relation | None

    def to_json(self) -> dict[str, Any]:
        """teachframe.base/1."""
        return report.base_json(self.bases, self.relation)

    def to_text(self) -> str:
        """A page for a person."""
        parts = [report.base_text(b) for b in self.bases]
        return "\n".join(parts + ([report.relation_text(self.relation)] if self.relation else []))


def run_base(
    files: Sequence[Path],
    *,
    robot: str | None = None,
    patterns: Sequence[str] = (),
    meeting_mm: Sequence[float] | None = None,
) -> BaseResult:
    """Reads one or two files and finds the base(s).

    Args:
        files: one or two.
        robot: description by name or path; None takes what each file says.
        patterns: AXIS=PATTERN for exports whose point names do not say the axis.
        meeting_mm: where both tools meet, in base 1 [mm].

    Raises:
        InputError, DegenerateGeometryError: as the readers and the solver say, naming the file.
    """
    bases = []
    for path in files:
        arcs = read_arcs(read_table(path))
        model, trouble = description(arcs, robot)
        try:
            base = solve_base(arcs, model)
        except DegenerateGeometryError as error:
            raise error.in_file(path) from None
        bases.append(base if trouble is None else _with_warning(base, trouble))
    meeting = None if meeting_mm is None else from_mm(np.array(meeting_mm, float))
    return BaseResult(tuple(bases), relate(bases[0], bases[1], meeting) if len(bases) == 2 else None)


def description(arcs: Arcs, robot: str | None) -> tuple[RobotModel | None, Warning_ | None]:
    """The robot's description; one that a file names and that is not there is worth a warning, not a refusal."""
    if robot is not None:
        return load_robot(robot), None
    if arcs.robot is None:
        return None, None
    try:
        return load_robot(arcs.robot, relative_to=arcs.path.parent), None
    except InputError as error:
        return None, Warning_("robot", f"no maker's frame: {error}", "give --robot")


def _with_warning(base: BaseCalibration, warning: Warning_) -> BaseCalibration:
    return replace(base, warnings=(*base.warnings, warning))
