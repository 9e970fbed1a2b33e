"""What following the proposed touches brings: the tool point's error against random and against greedy touches.

All start from the same first touch, tilt up to 30 degrees and turn about the tool up to 45; the random ones are spread
evenly over the cap of tilts. On a real arm everything must also be reachable and free of collision.

Run: python -m benchmarks.tool_next_touch
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.calibration.next_touch import TouchLimits, propose
from app.calibration.next_touch.candidates import candidates, tilted
from app.calibration.next_touch.plan import plan_touches
from app.calibration.solvers.joint import solve_joint
from app.kinematics import CollisionWorld, load_robot

NOISE, SETS, REPEATS = 3e-4, 4000, 4000
TOOL = np.array([0.1195, 0.0, 0.352])
LIMITS = TouchLimits()


@dataclass(frozen=True)
class Row:
    """Median error of the tool point [m]; ratio below 1 means that the proposal is better."""

    name: str
    ours: float
    peer: float
    peer_name: str

    @property
    def ratio(self) -> float:
        return self.ours / self.peer


def errors(rotations: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """(m,) length of the tool point's error for one noisy calibration each; rotations (m, n, 3, 3)."""
    positions = -rotations @ TOOL + rng.normal(0.0, NOISE, rotations.shape[:-1])
    return np.linalg.norm(solve_joint(rotations, positions)[0] - TOOL, axis=1)


def random_sets(first: np.ndarray, axis: np.ndarray, count: int, rng: np.random.Generator) -> np.ndarray:
    """(SETS, count, 3, 3) the first touch, then random ones within the limits."""
    shape = SETS * (count - 1)
    tilt = LIMITS.tilt * np.sqrt(rng.uniform(0.0, 1.0, shape))
    turn = rng.uniform(-LIMITS.turn, LIMITS.turn, shape)
    drawn = tilted(first, axis, tilt, rng.uniform(0.0, 2.0 * np.pi, shape), turn)
    sets = drawn.reshape(SETS, count - 1, 3, 3)
    return np.concatenate([np.broadcast_to(first, (SETS, 1, 3, 3)), sets], axis=1)


def follow(first: np.ndarray, count: int, step: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """(count, 3, 3) touches, each asked for after the one before was made."""
    made = first[None]
    while len(made) < count:
        made = np.concatenate([made, step(made)[None]])
    return made


def greedy(first: np.ndarray, axis: np.ndarray, count: int) -> np.ndarray:
    choice = candidates(first, axis, LIMITS)
    return follow(first, count, lambda made: choice[plan_touches(made, choice, 1)[0]])


def run() -> list[Row]:
    """Measures and gives the rows."""
    rng = np.random.default_rng(0)
    axis = TOOL / np.linalg.norm(TOOL)
    rows = []

    def median(touches: np.ndarray) -> float:
        return float(np.median(errors(np.broadcast_to(touches, (REPEATS, *touches.shape)), rng)))

    first = np.eye(3)
    for count in (3, 4, 5, 7):
        proposed = follow(
            first,
            count,
            lambda made, n=count: (
                propose(made, tool=TOOL, spike=np.zeros(3), touches=n).T_base_flange.rotation
            ),
        )
        ours = median(proposed)
        rows.append(
            Row(
                f"{count} touches",
                ours,
                float(np.median(errors(random_sets(first, axis, count, rng), rng))),
                "random",
            )
        )
        rows.append(Row(f"{count} touches", ours, median(greedy(first, axis, count)), "greedy"))
    robot = load_robot("jby50")
    world = CollisionWorld(robot)
    flange = robot.forward(robot.home)
    spike, first = flange.apply(TOOL), flange.rotation

    def on_the_arm(made: np.ndarray) -> np.ndarray:
        found = propose(made, tool=TOOL, spike=spike, touches=4, robot=robot, collides=world.check)
        return found.T_base_flange.rotation

    ours = median(follow(first, 4, on_the_arm))
    peer = float(np.median(errors(random_sets(first, axis, 4, rng), rng)))
    rows.append(Row("4 touches, reached by JBY-50", ours, peer, "random"))
    return rows


def main() -> None:
    print(f"{'what':<30}{'proposed':>12}{'peer':>12}{'ratio':>8}  peer")
    for row in run():
        print(
            f"{row.name:<30}{row.ours * 1e3:>9.3f} mm{row.peer * 1e3:>9.3f} mm{row.ratio:>8.2f}  {row.peer_name}"
        )


if __name__ == "__main__":
    main()
