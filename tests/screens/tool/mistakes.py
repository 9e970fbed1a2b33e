"""Points as they are recorded when something goes wrong: files of poses and of joint angles."""

import numpy as np

from app.calibration.captures import Capture
from app.geometry import CONVENTIONS, Pose, exp_so3, rot_x, rot_z
from app.kinematics import load_robot, solve_ik
from app.units import deg, mm
from tests.calibration.drawing import TOOL, captures, stroke, touches

NOISE = 1e-4
X, Y, Z = np.eye(3)
ANGLES = "x_mm,y_mm,z_mm,a_deg,b_deg,c_deg"


def rows_of(points, convention="ZYX"):
    """Roles and numbers in mm and degrees, one a capture."""
    form = CONVENTIONS[convention]
    for c in points:
        angles = form.from_rotation(c.T_base_flange.rotation)
        yield c.role, [*mm(c.T_base_flange.position), *(deg(angles) if form.angular else angles)]


def text_of(points, *, written="ZYX", stated="ZYX", columns=ANGLES, length=1.0, angle=1.0):
    lines = [f"# angles: {stated}", f"role,{columns}"]
    for role, numbers in rows_of(points, written):
        scaled = [length * v for v in numbers[:3]] + [angle * v for v in numbers[3:]]
        lines.append(f"{role}," + ",".join(f"{v:.9f}" for v in scaled))
    return "\n".join(lines) + "\n"


def touched(count=5, seed=0, **rest):
    return captures(*touches(count, 0.6, NOISE, seed, **rest))


def taught(*strokes):
    points = touched(5)
    last = points[-1]
    points[-1] = Capture(last.step_key, "touch+origin", last.T_base_flange, None, last.row)
    return text_of(points + [stroke(last, role, *rest) for role, *rest in strokes])


def tilted(count=5, seed=0):
    """Touches whose three angles are all at work."""
    rotations = touches(count, 0.6, NOISE, seed)[0] @ rot_x(np.pi - 0.4)
    return captures(*touches(count, rotations=rotations, noise=NOISE, seed=seed))


def almost_one_axis():
    lean = exp_so3(np.outer(np.array([0.0, 0.03, 0.0, -0.03, 0.02]), X))
    return captures(*touches(rotations=rot_z(np.linspace(0, 2, 5)) @ lean, noise=1e-5))


def alike():
    rotations, _ = touches(4, 0.6)
    rotations[3] = rotations[1] @ rot_x(0.03)
    return captures(*touches(rotations=rotations, noise=NOISE))


def spike_moved(start):
    rotations, positions = touches(7, 0.6, NOISE, start)
    positions[start - 1 :] += np.array([0.002, -0.001, 0.0])
    return captures(rotations, positions)


def tip_bent():
    rotations, _ = touches(7, 0.6, seed=1)
    tools = np.array([TOOL] * 4 + [TOOL + 0.004 * X] * 3)
    positions = np.array([1.0, 0.1, 0.4]) - np.einsum("nij,nj->ni", rotations, tools)
    return captures(rotations, positions + np.random.default_rng(0).normal(0, NOISE, (7, 3)))


def missed():
    rotations, positions = touches(6, 0.6, NOISE, 2)
    positions[3] += np.array([0.0, 0.003, 0.0])
    return captures(rotations, positions)


def tool_left_active():
    rotations, positions = touches(5, 0.6, NOISE)
    return captures(rotations, positions + rotations @ TOOL)


def both(change):
    """Joints and poses of one arm, the poses changed by `change(i, pose)`."""
    robot, rng = load_robot("ur10e"), np.random.default_rng(3)
    lines = [
        "# robot: ur10e",
        "# angles: ZYX",
        f"role,{ANGLES}," + ",".join(f"q{j}_deg" for j in range(1, 7)),
    ]
    for i in range(5):
        q = robot.home + rng.normal(0, 0.4, 6)
        pose = change(i, robot.forward(q))
        numbers = [*mm(pose.position), *deg(CONVENTIONS["ZYX"].from_rotation(pose.rotation)), *deg(q)]
        lines.append("touch," + ",".join(f"{v:.6f}" for v in numbers))
    return "\n".join(lines) + "\n"


def by_joints(flipped):
    """Touches of one spike as joint angles; those numbered have the wrist the other way round."""
    robot, tool = load_robot("ur10e"), Pose.of(None, TOOL)
    spike = robot.forward(robot.home) @ tool
    lines = ["# robot: ur10e", "role," + ",".join(f"q{j}_deg" for j in range(1, 7))]
    for number, turn in enumerate(WRIST_TURNS, 1):
        start = robot.home + (FLIP if number in flipped else 0.0)
        start[4] *= -1.0 if number in flipped else 1.0
        aim = Pose.of(spike.rotation @ exp_so3(np.array(turn)), spike.position)
        found = solve_ik(robot, aim, start, T_flange_tool=tool, max_steps=500)
        assert found.reached
        lines.append("touch," + ",".join(f"{v:.6f}" for v in deg(found.q)))
    return "\n".join(lines) + "\n"


WRIST_TURNS = ((0, 0, 0), (0.5, 0, 0.3), (-0.4, 0.3, 0), (0, -0.5, 0.6), (0.3, 0.4, -0.5))
FLIP = np.array([0.0, 0.0, 0.0, np.pi, 0.0, -np.pi])
SHIFT = Pose.of(None, np.array([0.05, 0.0, 0.0]))
TORCH = Pose.of(rot_x(0.3), np.array([0.0, 0.01, 0.12]))
