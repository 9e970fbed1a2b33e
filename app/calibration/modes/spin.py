"""Tool point by touches, then the tool's Z by spinning the tool about its own axis, tip and axis held in a sleeve.

While only the spin changes, the axis keeps its direction in base: R_i z = const. So z is the direction of the flange
that the mean of the rotations shortens least,

    z = the right singular vector of mean(R_i) with the largest singular value

and it points from the flange towards the tip. X is the flange's X made square to it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy import special

from app.calibration.captures import Capture, Demo, Step, of_role, stack
from app.calibration.modes._touches import (
    DEMO_SPIKE,
    TouchMode,
    demo_captures,
    demo_flange,
    demo_truth,
    demo_turn,
)
from app.calibration.orientation import frame_from_z, seen_axis
from app.calibration.result import AxisCone, ToolCalibration
from app.calibration.tool import calibrate, checked
from app.calibration.wording import degenerate
from app.errors import TooFewPointsError
from app.geometry import Pose, rot_z
from app.units import deg, from_deg

_SPINS = 3
#: Least spread of the spin that shows an axis [rad].
LEAST_SPIN = from_deg(10.0)


@dataclass(frozen=True)
class Spin:
    key: str = "spin"
    title: str = "Tool point, then Z by spinning about the tool's axis"
    least_touches: int = 3
    most_touches: int = 7
    default_touches: int = 4

    def steps(self, touches: int = 4) -> tuple[Step, ...]:
        base = TouchMode("", "", "default", (), True, self.least_touches, self.most_touches)
        text = "Keep the tool's axis where it is, turn the tool about it by 60 degrees or more, and record."
        spins = (Step(f"spin{i}", "spin", f"Spin {i}", text, "spin") for i in range(1, _SPINS + 1))
        return (*base.steps(touches), *spins)

    def solve(self, captures: Sequence[Capture], **options: Any) -> ToolCalibration:
        options["orientation"] = "default"
        context = options.pop("context", None)
        result = calibrate(captures, context={"quiet": True}, **options)
        z, axis_cone = _axis(of_role(captures, "spin"), result.tool_point)
        rotation = frame_from_z(seen_axis("z", z))
        found = replace(
            result,
            T_flange_tool=Pose.of(rotation, result.tool_point),
            orientation=self.key,
            cones=axis_cone,
            warnings=(),
        )
        return checked(found, captures, context)

    def demo(self, *, touches: int = 4, noise: float = 0.0, seed: int = 0) -> Demo:
        rng = np.random.default_rng(seed)
        steps = self.steps(touches)
        captures = demo_captures(steps[:-_SPINS], rng, noise)
        stand = demo_turn(rng, 0)
        for number, step in enumerate(steps[-_SPINS:]):
            flange = demo_flange(rng, DEMO_SPIKE, stand @ rot_z(1.1 * number), noise)
            captures.append(Capture(step.key, step.role, flange, None, len(captures) + 1))
        return Demo(tuple(captures), demo_truth("z"), {})


def _axis(spins: Sequence[Capture], tool: np.ndarray) -> tuple[np.ndarray, tuple[AxisCone, ...]]:
    if len(spins) < 2:
        raise degenerate(
            "too_few", "too_few_spin", kind=TooFewPointsError, rank=0, needed=2, count=len(spins)
        )
    rotations, _ = stack(spins)
    mean = rotations.mean(axis=0)
    _, values, directions = np.linalg.svd(mean)
    spread = float(np.sqrt(max(1.0 - values[1] ** 2, 0.0)))
    if spread < np.sin(LEAST_SPIN):
        turned = float(deg(np.arcsin(min(spread, 1.0))))
        raise degenerate("short_stroke", "short_spin", rank=0, needed=1, unseen="tool Z", deg=turned)
    z = directions[0] * (1.0 if directions[0] @ tool >= 0 else -1.0)
    wobble = rotations @ z - mean @ z
    dof = 2 * len(spins) - 4
    if dof <= 0:
        return z, ()
    noise = np.sqrt(np.sum(wobble**2) / dof)
    sigma = float(noise / np.sqrt(len(spins)) / spread)
    half = float(np.arctan(sigma * np.sqrt(2.0 * special.fdtri(2, dof, 0.95))))
    return z, (AxisCone("z", 0.0, sigma, half),)


MODE = Spin()
