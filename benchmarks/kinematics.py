"""Forward and inverse kinematics per call, against plain pin doing the same work by hand.

Run: python -m benchmarks.kinematics
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
import pinocchio as pin

from app.geometry import Pose
from app.kinematics import CollisionWorld, load_robot, solve_ik
from app.kinematics.shapes import box, floor, rod
from app.kinematics.solids import tool_shapes
from benchmarks.rows import Row

ROUNDS, CALLS = 40, 50


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
    rows.append(Row("inverse kinematics, drag step of 5 mm", ours, plain, "plain pin, damped", aim=1e-4))
    ours, plain = quickest(
        lambda i: solve_ik(robot, tool_targets[i], robot.home, T_flange_tool=tool),
        lambda i: plain_inverse(model, data, frame, plain_targets[i], robot.home),
    )
    rows.append(Row("the same, aiming the tool point", ours, plain, "plain pin, damped (flange)", aim=1e-4))
    batch = quickest(lambda i: chain.frames(many) if i == 0 else None)[0] * CALLS / len(many)
    rows.append(Row("forward kinematics in a batch of 2000", batch, rows[0].peer, "plain pin in a loop"))
    things = [
        floor(-0.01),
        box((0.6, 0.6, 0.4), (1.3, 0.0, 0.2), link="table"),
        rod((1.3, 0.0, 0.4), (1.3, 0.0, 0.6), 0.02, 0.0, link="spike"),
        box((0.05, 3.0, 2.0), (-1.5, 0.0, 1.0), link="fence"),
    ]
    world = CollisionWorld(robot, tool_shapes=tool_shapes(robot), obstacles=things)
    geometry, geometry_data = world._geometry, pin.GeometryData(world._geometry)

    def all_distances(q):
        pin.computeDistances(model, data, geometry, geometry_data, q)

    near = robot.home + rng.normal(0, 0.1, (CALLS, 6))
    ours, plain = quickest(lambda i: world.check(near[i]), lambda i: all_distances(near[i]))
    pairs = len(world.pairs)
    rows.append(Row(f"collision check, {pairs} pairs", ours, plain, "pin, distances of all pairs", aim=1e-4))
    ours, plain = quickest(lambda i: world.distance(near[i]), lambda i: all_distances(near[i]))
    rows.append(Row("nearest pair and its distance", ours, plain, "pin, distances of all pairs", aim=1e-4))
    return rows


def main() -> None:
    print(f"{'what':<42}{'ours':>11}{'peer':>11}{'ratio':>8}  peer")
    for row in run():
        print(
            f"{row.name:<42}{row.ours * 1e6:>8.1f} us{row.peer * 1e6:>8.1f} us{row.ratio:>8.2f}  {row.peer_name}"
        )


if __name__ == "__main__":
    main()
