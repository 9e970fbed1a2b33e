"""What can be wrong with a set of captures: one file a check.

Each file has `CHECK` with `key` and `look(result, captures, context) -> list[Warning_]`. A check never changes the
result and never leaves a point out: it says what it saw, with the figures, and what to do next.

Two things are refused outright, before there is a result: too few touches and touches about one axis
(app/calibration/solvers/point_fit.py; codes `too_few`, `one_axis`). `refusal` turns such an error into the same shape.
"""

from collections.abc import Sequence
from typing import Any, Protocol

from app.calibration.captures import Capture
from app.calibration.result import ToolCalibration, Warning_
from app.errors import DegenerateGeometryError
from app.phrases import Phrase


class Check(Protocol):
    """A file under checks/ with an object `CHECK` of this shape is a check."""

    key: str

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        """What was found; [] where nothing is wrong.

        `context` may hold: `points` (the file), `tool_active` (True or the name of the tool the poses are of),
        `session_tool` (the tool that is active where the points were solved, a `SessionTool`), `quiet`.
        """
        ...


def refusal(error: DegenerateGeometryError) -> Warning_:
    """A refusal as a warning, for screens that show both in one list."""
    said = error.said if isinstance(error.said, Phrase) else None
    parts = (said.fields["seen"], said.fields["todo"]) if said else ()
    return Warning_(error.code, error.message, error.advice or "", severe=True, phrases=parts)
