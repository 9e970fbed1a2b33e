"""A known tool touches a point first, then the new one touches the same point (KUKA: XYZ reference).

    s = R_k t_known + p_k,      t = R_i^T (s - p_i)

One touch each is enough, because the known tool says where the point is; more show how well they agree.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture, Demo, Step, of_role, stack
from app.calibration.modes._touches import DEMO_SPIKE, DEMO_TOOL, demo_flange, demo_turn
from app.calibration.result import ToolCalibration
from app.calibration.solvers.pairwise import delta
from app.calibration.tool import checked
from app.calibration.wording import degenerate
from app.errors import CellValueError, TooFewPointsError
from app.geometry import Pose
from app.units import from_mm

#: One-sigma noise of a touch that is assumed where too few touches tell it [m].
ASSUMED_NOISE = from_mm(0.3)
_DEMO_KNOWN = from_mm(np.array([0.0, 0.0, 150.0]))


@dataclass(frozen=True)
class Reference:
    key: str = "reference"
    title: str = "Reference by a known tool"
    least_touches: int = 1
    most_touches: int = 7
    default_touches: int = 2

    def steps(self, touches: int = 2) -> tuple[Step, ...]:
        count = min(max(touches, self.least_touches), self.most_touches)
        known = "With the known tool mounted and chosen, bring its tip to the spike and record."
        new = "Mount the new tool, bring its tip to the same spike and record."
        return (
            Step("known", "known", "Known tool", known, "known"),
            *(Step(f"touch{i}", "touch", f"New tool {i}", new, "touch") for i in range(1, count + 1)),
        )

    def solve(
        self,
        captures: Sequence[Capture],
        *,
        known_tool: Sequence[float] | None = None,
        context: dict[str, Any] | None = None,
        **_: Any,
    ) -> ToolCalibration:
        """The new tool's point; its axes stay the flange's.

        Args:
            captures: roles `known` and `touch`.
            known_tool: (3,) tool point of the known tool in the flange [m].
            context: what checks may know besides.

        Raises:
            CellValueError: the known tool is not stated.
            TooFewPointsError: a capture of either tool is missing.
        """
        if known_tool is None or np.shape(known_tool) != (3,):
            raise CellValueError(
                "the known tool is not stated",
                column="known_tool",
                expected="its tool point, x, y, z in the flange",
            )
        known, new = of_role(captures, "known"), of_role(captures, "touch")
        for found, key in ((known, "too_few_known"), (new, "too_few_new")):
            if not found:
                raise degenerate("too_few", key, kind=TooFewPointsError, rank=0, needed=1)
        R_known, p_known = stack(known)
        R_new, p_new = stack(new)
        spikes = R_known @ np.asarray(known_tool, float) + p_known
        a, b = len(known), len(new)
        # Unknown (t, s): known touches say s directly, new ones R_i t - s = -p_i.
        matrix = np.zeros((a + b, 3, 6))
        matrix[:a, :, 3:] = np.eye(3)
        matrix[a:, :, :3], matrix[a:, :, 3:] = R_new, -np.eye(3)
        rhs = np.concatenate([spikes, -p_new]).reshape(-1)
        tall = matrix.reshape(-1, 6)
        solution = np.linalg.lstsq(tall, rhs, rcond=None)[0]
        tool, spike = solution[:3], solution[3:]
        dof = 3 * (a + b) - 6
        residual = tall @ solution - rhs
        sigma = float(np.sqrt(residual @ residual / dof)) if dof else ASSUMED_NOISE
        inverse = np.linalg.inv(tall.T @ tall)
        gains = -(inverse @ np.swapaxes(matrix[a:], 1, 2))[:, :3]
        values = np.linalg.svd(tall, compute_uv=False)
        result = ToolCalibration(
            T_flange_tool=Pose.of(None, tool),
            p_base=spike,
            method=self.key,
            orientation="default",
            residual_vectors=R_new @ tool + p_new - spike,
            delta=delta(R_new, p_new, tool),
            covariance=inverse[:3, :3] * sigma**2,
            sigma=sigma,
            dof=dof,
            condition=float(values[0] / values[-1]),
            rank=3,
            rows=tuple(c.row or i + 1 for i, c in enumerate(new)),
            gains=gains,
            weights=np.ones(b),
        )
        return checked(result, captures, context)

    def demo(self, *, touches: int = 2, noise: float = 0.0, seed: int = 0) -> Demo:
        rng = np.random.default_rng(seed)
        steps = self.steps(touches)
        known = demo_turn(rng, 1)
        tip = DEMO_SPIKE + rng.normal(0.0, noise, 3)
        captures = [Capture("known", "known", Pose.of(known, tip - known @ _DEMO_KNOWN), None, 1)]
        for number, step in enumerate(steps[1:], 2):
            flange = demo_flange(rng, DEMO_SPIKE, demo_turn(rng, number), noise)
            captures.append(Capture(step.key, step.role, flange, None, number))
        truth = Pose.of(None, DEMO_TOOL.position)
        return Demo(tuple(captures), truth, {"known_tool": tuple(_DEMO_KNOWN)})


MODE = Reference()
