"""What modes that touch one fixed point have in common."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture, Demo, Step
from app.calibration.result import ToolCalibration
from app.calibration.tool import calibrate
from app.geometry import Pose, exp_so3, rot_y, rot_z
from app.units import from_mm

#: Tool and touched point that demonstrations are drawn from: a torch bent by 54.3 degrees, a spike on a table.
DEMO_TOOL = Pose.of(rot_z(0.1) @ rot_y(0.9477), from_mm(np.array([119.5, 3.0, 352.0])))
DEMO_SPIKE = from_mm(np.array([980.0, 40.0, 420.0]))
DEMO_STROKE = from_mm(150.0)

_TOUCH = (
    "Bring the tool tip to the spike and record.",
    "Turn the tool by 45 degrees or more about another axis, touch the same spike again and record.",
)
_STROKES = {
    "x": "Without turning the tool, move the tip along the tool's +X by 100 mm or more and record.",
    "y": "Without turning the tool, move the tip along the tool's +Y by 100 mm or more and record.",
    "z": "Without turning the tool, move the tip along the tool's +Z by 100 mm or more and record.",
}


@dataclass(frozen=True)
class TouchMode:
    """N touches of one point, then strokes from an origin.

    Args:
        orientation: key of app/calibration/tool.py's ORIENTATIONS.
        strokes: axes in the order they are asked for.
        shared_origin: True where the last touch is the origin too; False where the origin is a step of its own.
    """

    key: str
    title: str
    orientation: str
    strokes: tuple[str, ...]
    shared_origin: bool = True
    least_touches: int = 3
    most_touches: int = 7
    default_touches: int = 4

    def steps(self, touches: int = 4) -> tuple[Step, ...]:
        count = min(max(touches, self.least_touches), self.most_touches)
        out = []
        for i in range(1, count + 1):
            both = i == count and self.shared_origin and self.strokes
            text = _TOUCH[min(i - 1, 1)]
            if both:
                text += " The strokes start here: choose a pose from which the tip can move freely."
            role = "touch+origin" if both else "touch"
            out.append(Step(f"touch{i}", role, f"Touch {i}", text, "origin" if both else "touch"))
        if self.strokes and not self.shared_origin:
            text = "Stand the tool as its axes shall be taught, tip on the spike, and record."
            out.append(Step("origin", "origin", "Orient origin", text, "origin"))
        for name in self.strokes:
            title = f"+{name.upper()} direction"
            out.append(Step(name, name, title, _STROKES[name], f"stroke_{name}"))
        return tuple(out)

    def solve(self, captures: Sequence[Capture], **options: Any) -> ToolCalibration:
        options.setdefault("orientation", self.orientation)
        return calibrate(captures, **options)

    def demo(self, *, touches: int = 4, noise: float = 0.0, seed: int = 0) -> Demo:
        rng = np.random.default_rng(seed)
        return Demo(
            tuple(demo_captures(self.steps(touches), rng, noise)),
            demo_truth(self.orientation),
            {"method": "joint"},
        )


def demo_truth(orientation: str) -> Pose:
    """The tool frame a flawless calibration of this orientation finds."""
    if orientation == "default":
        return Pose.of(None, DEMO_TOOL.position)
    if orientation == "z":
        z = DEMO_TOOL.rotation[:, 2]
        x = np.array([1.0, 0.0, 0.0]) - z[0] * z
        x /= np.linalg.norm(x)
        return Pose.of(np.stack([x, np.cross(z, x), z], axis=1), DEMO_TOOL.position)
    return DEMO_TOOL


def demo_flange(rng: np.random.Generator, tip: np.ndarray, R_base_tool: np.ndarray, noise: float) -> Pose:
    """The flange that holds DEMO_TOOL's tip at `tip` [m], missed by `noise` [m] on each axis."""
    rotation = R_base_tool @ DEMO_TOOL.rotation.T
    return Pose.of(rotation, tip + rng.normal(0.0, noise, 3) - rotation @ DEMO_TOOL.position)


def demo_turn(rng: np.random.Generator, number: int, tilt: float = 0.6) -> np.ndarray:
    """R_base_tool of touch `number`: tip down, tilted another way each time."""
    around = 2.4 * number + rng.uniform(-0.2, 0.2)
    lean = exp_so3(tilt * np.array([np.cos(around), np.sin(around), 0.0]) * (number > 0))
    return lean @ exp_so3(np.array([np.pi, 0.0, 0.0])) @ rot_z(rng.uniform(-0.7, 0.7))


def demo_captures(steps: Sequence[Step], rng: np.random.Generator, noise: float) -> list[Capture]:
    """One capture a step, for roles touch, origin, x, y, z."""
    out: list[Capture] = []
    turn = np.eye(3)
    for number, step in enumerate(steps):
        tip = DEMO_SPIKE
        if step.role in ("x", "y", "z"):
            tip = tip + DEMO_STROKE * turn[:, "xyz".index(step.role)]
        else:
            turn = demo_turn(rng, number)
        flange = demo_flange(rng, tip, turn, noise)
        out.append(Capture(step.key, step.role, flange, None, number + 1))
    return out
