"""Forward and inverse kinematics per call, against plain pin doing the same work by hand.

Run: python -m benchmarks.kinematics
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from app.geometry import Pose
from app.kinematics import CollisionWorld, load_robot, solve_ik

ROUNDS, CALLS = 40, 50


@dataclass(frozen=True)
class Row:
    """One line of the table; both times of one call [s]; ratio below 1 means that ours is quicker."""

    name: str
    ours: float
    peer: float
    peer_name: str

    @property
    def ratio(self) -> float:
        return self.ours / self.peer if self.peer else float("nan")


def quickest(*functions: Callable[[int], object]) -> list[float]:
    """Seconds a call, each the best of many short rounds taken in turn, so that other load hits all alike."""
    best = [float("inf")] * len(functions)
    for _ in range(ROUNDS):
        for k, function in enumerate(functions):
            start = time.perf_counter()
            for i in range(CALLS):
                function(i)
            best[k] = min(best[k], (time.perf_counter() - start) / CALLS)
    return best


def plain_inverse(model, data, frame, target, q, damping=1e-8, tolerance=1e-6, max_steps=60):
    """Damped least squares as pin's own example does it: no limits, no reasons, no step control."""
    for _ in range(max_steps):
        pin.framesForwardKinematics(model, data, q)
        error = pin.log(data.oMf[frame].actInv(target)).vector
        if np.linalg.norm(error) < tolerance:
            break
        jacobian = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL)
        q = q + jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + damping * np.eye(6), error)
    return q


def run() -> list[Row]:
    """Measures and gives the rows."""
    robot = load_robot("jby50")
    model, data, frame = robot.model, robot.model.createData(), robot.flange_id
    rng = np.random.default_rng(0)
    angles = robot.home + rng.normal(0, 0.3, (CALLS, 6))
    start = robot.forward(robot.home)
    targets = [Pose.of(start.rotation, start.position + rng.normal(0, 0.005, 3)) for _ in range(CALLS)]
    plain_targets = [pin.SE3(t.rotation, t.position) for t in targets]
    tool = Pose.of(None, np.array([0.1195, 0.0, 0.352]))
    tool_targets = [t @ tool for t in targets]
    chain, many = robot.chain, robot.home + rng.normal(0, 0.3, (2000, 6))

    def plain_forward(i: int):
        pin.framesForwardKinematics(model, data, angles[i])
        return data.oMf[frame].homogeneous

    ours, plain = quickest(lambda i: robot.flange_matrix(angles[i]), plain_forward)
    rows = [Row("forward kinematics, one pose", ours, plain, "plain pin")]
    ours, plain = quickest(
        lambda i: solve_ik(robot, targets[i], robot.home),
        lambda i: plain_inverse(model, data, frame, plain_targets[i], robot.home),
    )
    rows.append(Row("inverse kinematics, drag step of 5 mm", ours, plain, "plain pin, damped"))
    ours, plain = quickest(
        lambda i: solve_ik(robot, tool_targets[i], robot.home, T_flange_tool=tool),
        lambda i: plain_inverse(model, data, frame, plain_targets[i], robot.home),
    )
    rows.append(Row("the same, aiming the tool point", ours, plain, "plain pin, damped (flange)"))
    begin = time.perf_counter()
    chain.frames(many)
    batch = (time.perf_counter() - begin) / len(many)
    rows.append(Row("forward kinematics in a batch of 2000", batch, rows[0].peer, "plain pin in a loop"))
    world = CollisionWorld(robot)
    ours, plain = quickest(lambda i: world.check(angles[i]), plain_forward)
    rows.append(Row("collision check, arm with itself", ours, plain, "plain pin, forward only"))
    return rows


def main() -> None:
    print(f"{'what':<42}{'ours':>11}{'peer':>11}{'ratio':>8}  peer")
    for row in run():
        print(
            f"{row.name:<42}{row.ours * 1e6:>8.1f} us{row.peer * 1e6:>8.1f} us{row.ratio:>8.2f}  {row.peer_name}"
        )


if __name__ == "__main__":
    main()
