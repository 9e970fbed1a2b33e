"""Tool point by touches, then axes by standing the tool parallel to the base's (KUKA: ABC world).

With all three axes: the tool's X points down base -Z, its Y along base +Y, its Z along base +X. With X alone, the
turn about it is open: Y is then the flange's Y made square to X.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from app.calibration.captures import Capture, Demo, Step, the_one
from app.calibration.modes._touches import DEMO_SPIKE, DEMO_TOOL, TouchMode, demo_captures, demo_flange
from app.calibration.orientation import frame_from, seen_axis
from app.calibration.result import ToolCalibration
from app.calibration.tool import calibrate, checked
from app.geometry import Pose
from app.units import from_mm

#: R_base_tool of the pose that the operator brings about.
R_WORLD = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])


@dataclass(frozen=True)
class AbcWorld:
    key: str = "abc_world"
    title: str = "Tool point, then the tool parallel to the base"
    least_touches: int = 3
    most_touches: int = 7
    default_touches: int = 4

    def steps(self, touches: int = 4) -> tuple[Step, ...]:
        base = TouchMode("", "", "default", (), True, self.least_touches, self.most_touches)
        text = "Stand the tool so that its X points down, its Y along the base's +Y, its Z along the base's +X; record."
        return (*base.steps(touches), Step("world", "world", "Parallel to the base", text, "world"))

    def solve(
        self, captures: Sequence[Capture], *, axes: Literal["all", "x"] = "all", **options: Any
    ) -> ToolCalibration:
        options["orientation"] = "default"
        context = options.pop("context", None)
        result = calibrate(captures, context={"quiet": True}, **options)
        rotation = the_one(captures, "world").T_base_flange.rotation.T @ R_WORLD
        if axes == "x":
            x = rotation[:, 0]
            helper = 1 if abs(x[1]) < 0.99 else 2
            rotation = frame_from(seen_axis("x", x), seen_axis("y", np.eye(3)[helper]))
        pose = Pose.of(rotation, result.tool_point)
        return checked(
            replace(result, T_flange_tool=pose, orientation=self.key, warnings=()), captures, context
        )

    def demo(self, *, touches: int = 4, noise: float = 0.0, seed: int = 0) -> Demo:
        rng = np.random.default_rng(seed)
        steps = self.steps(touches)
        captures = demo_captures(steps[:-1], rng, noise)
        above = DEMO_SPIKE + from_mm(np.array([0.0, 0.0, 200.0]))
        flange = demo_flange(rng, above, R_WORLD, noise)
        captures.append(Capture("world", "world", flange, None, len(captures) + 1))
        return Demo(tuple(captures), DEMO_TOOL, {})


MODE = AbcWorld()
