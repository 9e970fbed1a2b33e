"""The touch that would help a solved points file most; none where the result is good as it stands."""

from __future__ import annotations

from app.calibration.captures import of_role, stack
from app.calibration.next_touch.proposal import Proposal, propose
from app.calibration.solving import Solved
from app.calibration.tool import METHODS
from app.errors import DegenerateGeometryError


def advised_touch(solved: Solved) -> Proposal | DegenerateGeometryError | None:
    """The best next touch; why there is none that the arm can take up; None where none is needed."""
    result, points = solved.result, solved.points
    if solved.light.colour == "green" or result.method not in METHODS or not result.sigma > 0:
        return None
    touches = of_role(points.captures, "touch")
    rotations, _ = stack(touches)
    try:
        return propose(
            rotations,
            tool=result.tool_point,
            spike=result.p_base,
            touches=len(touches) + 1,
            noise=result.sigma,
            robot=points.robot,
            q_near=touches[-1].q,
        )
    except DegenerateGeometryError as error:
        return error
