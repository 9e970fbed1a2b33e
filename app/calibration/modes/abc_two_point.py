"""Tool point by touches, then axes by showing two more points of the tool to the same spike (KUKA: ABC 2-point).

The spike s is fixed; seen from the flange it lies at T^-1 s. Brought there are the tip, a point on the tool's -X and
a point of the tool's XY plane on the side of +Y, so

    x = t - T_x^-1 s,      y = T_xy^-1 s - t made square to x,      z = x cross y

and the tool may be turned between the captures.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from app.calibration.captures import Capture, Demo, Step, the_one
from app.calibration.modes._touches import DEMO_SPIKE, DEMO_TOOL, TouchMode, demo_captures, demo_flange
from app.calibration.orientation import Axis, cone, frame_from, seen_axis
from app.calibration.result import ToolCalibration
from app.calibration.tool import calibrate, checked
from app.geometry import Pose
from app.units import from_mm

_DEMO_LENGTH = from_mm(120.0)


@dataclass(frozen=True)
class AbcTwoPoint:
    key: str = "abc_two_point"
    title: str = "Tool point, then a point on -X and one of the XY plane"
    least_touches: int = 3
    most_touches: int = 7
    default_touches: int = 4

    def steps(self, touches: int = 4) -> tuple[Step, ...]:
        base = TouchMode("", "", "default", (), True, self.least_touches, self.most_touches)
        return (
            *base.steps(touches),
            Step(
                "minus_x",
                "minus_x",
                "Point on -X",
                "Bring a point of the tool's own -X axis (back along the tool) to the same spike and record.",
                "minus_x",
            ),
            Step(
                "xy",
                "xy",
                "Point of the XY plane",
                "Bring a point of the tool's XY plane with positive Y to the same spike and record.",
                "xy_plane",
            ),
        )

    def solve(self, captures: Sequence[Capture], **options: Any) -> ToolCalibration:
        options["orientation"] = "default"
        context = options.pop("context", None)
        result = calibrate(captures, context={"quiet": True}, **options)
        x = self._sighting("x", the_one(captures, "minus_x"), result, -1.0)
        y = self._sighting("y", the_one(captures, "xy"), result, 1.0)
        rotation = frame_from(x, y)
        cones = tuple(cone(axis, result.covariance, result.sigma, result.dof) for axis in (x, y))
        found = replace(
            result,
            T_flange_tool=Pose.of(rotation, result.tool_point),
            orientation=self.key,
            cones=cones,
            warnings=(),
        )
        return checked(found, captures, context)

    @staticmethod
    def _sighting(name: str, capture: Capture, result: ToolCalibration, sign: float) -> Axis:
        spike = capture.T_base_flange.inverse().apply(result.p_base)
        return seen_axis(name, sign * (spike - result.tool_point), np.eye(3))

    def demo(self, *, touches: int = 4, noise: float = 0.0, seed: int = 0) -> Demo:
        rng = np.random.default_rng(seed)
        steps = self.steps(touches)
        captures = demo_captures(steps[:-2], rng, noise)
        turn = captures[0].T_base_flange.rotation @ DEMO_TOOL.rotation
        for step, shown in zip(steps[-2:], ([-1.0, 0.0, 0.0], [0.3, 1.0, 0.0]), strict=True):
            tip = DEMO_SPIKE - turn @ (_DEMO_LENGTH * np.array(shown))
            flange = demo_flange(rng, tip, turn, noise)
            captures.append(Capture(step.key, step.role, flange, None, len(captures) + 1))
        return Demo(tuple(captures), DEMO_TOOL, {})


MODE = AbcTwoPoint()
