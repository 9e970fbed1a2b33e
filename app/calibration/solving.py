"""One points file from reading to everything that can be said of it."""

from __future__ import annotations

import inspect
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.calibration.captures import Capture, of_role
from app.calibration.modes import mode
from app.calibration.points import Points, read_points
from app.calibration.quality.leave_one_out import LeftOut, leave_one_out
from app.calibration.quality.light import Light, light
from app.calibration.quality.references import Gap, gap_to
from app.calibration.quality.rounding import Rounding, least_turn, rounding
from app.calibration.result import ToolCalibration
from app.calibration.tool import calibrate
from app.errors import DegenerateGeometryError, InputError, UnknownNameError

#: Header key `# known_tool_mm`: the tool that touches first in the mode `reference`.
KNOWN = "known_tool"


@dataclass(frozen=True, eq=False)
class Solved:
    """A points file with its tool frame and its quality."""

    points: Points
    result: ToolCalibration
    rounding: Rounding
    gaps: tuple[Gap, ...]
    left_out: tuple[LeftOut, ...]
    light: Light


def solve_file(
    path: str | Path,
    *,
    method: str = "joint",
    orientation: str | None = None,
    mode_key: str | None = None,
    options: dict[str, Any] | None = None,
    robot: str | None = None,
) -> Solved:
    """Reads and solves one points file.

    Args:
        path: the file.
        method: "joint", "pairwise" or "robust".
        orientation: "default", "z", "zx", "xy"; None takes what the roles in the file allow.
        mode_key: solve by this wizard mode instead of touches and strokes.
        options: further options of that mode.
        robot: the arm's address, for joints; None takes the header's.

    Raises:
        InputError, DegenerateGeometryError: name the file.
    """
    points = read_points(path, robot)
    try:
        if mode_key is not None:
            given = {"context": {"points": points}, **(options or {})}
            if (
                KNOWN in points.references
                and "known_tool" in inspect.signature(mode(mode_key).solve).parameters
            ):
                given.setdefault("known_tool", points.references[KNOWN])
            result = mode(mode_key).solve(points.captures, **given)
        else:
            result = calibrate(
                points.captures,
                method=method,
                orientation=orientation,
                least_turn=least_turn(points),
                context={"points": points},
            )
    except DegenerateGeometryError as error:
        raise _placed(error, points) from None
    except UnknownNameError:
        raise
    except InputError as error:
        raise type(error)(
            error.problem, file=points.path, row=error.row, column=error.column, expected=error.expected
        ) from None
    effect = rounding(points, result)
    stated = {name: point for name, point in points.references.items() if name != KNOWN}
    gaps = tuple(gap_to(name, point, result, effect) for name, point in stated.items())
    left = leave_one_out(points.captures) if len(result.residual_vectors) else ()
    return Solved(points, result, effect, gaps, left, light(result))


def _placed(error: DegenerateGeometryError, points: Points) -> DegenerateGeometryError:
    """The error with the rows and columns it speaks of."""
    touches: Sequence[Capture] = of_role(points.captures, "touch") or points.captures
    rows = sorted({c.row for c in touches})
    where = f"row {rows[0]}" if len(rows) == 1 else f"rows {rows[0]} to {rows[-1]}"
    names = points.written.names
    turning = names[3:] if points.written.convention else names
    columns = "role" if error.code == "too_few" else ", ".join(turning)
    return type(error)(
        f"{where}, column {columns}: {error.message}",
        rank=error.rank,
        needed=error.needed,
        unseen=error.unseen,
        advice=error.advice,
        code=error.code,
        file=points.path,
        said=error.said,
    )
