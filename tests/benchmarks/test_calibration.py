"""The ordinary calibration that real recordings are compared with: right derivatives, known deviations found again."""

import numpy as np
import pytest

from app.kinematics import load_robot
from benchmarks._calibration.chain import Chain, Deviation
from benchmarks._calibration.fit import ELASTIC, GEOMETRY, NOTHING, errors, near, residual, rms, solve, start
from benchmarks._calibration.peer import calibrate, carried
from benchmarks._calibration.readings import read

ROBOT = "ur10e"
NOISE = 0.05e-3  # m
TOOL = np.array([[0.05, -0.03, 0.12]])


@pytest.fixture(scope="module")
def robot():
    return load_robot(ROBOT)


def arm_off_everywhere(n: int, seed: int) -> Deviation:
    """Zeros of 1 mrad, lengths of 0.3 mm, turns of 0.5 mrad; joint 2 yields by 10 urad/Nm."""
    rng = np.random.default_rng(seed)
    shifts, turns = 3e-4 * rng.normal(size=(n, 3)), 5e-4 * rng.normal(size=(n, 3))
    shifts[0] = turns[0] = 0.0
    return Deviation(1e-3 * rng.normal(size=n), shifts, turns, 1e-5 * (np.arange(n) == 1))


def written(path, robot, arm: Deviation, rows: int, seed: int):
    """A tracker recording of that arm, the instrument turned and moved."""
    rng = np.random.default_rng(seed)
    chain = Chain(robot)
    q = rng.uniform(-1.6, 1.6, (rows, chain.n))
    tools = np.broadcast_to(TOOL, (rows, 1, 3))
    points, _, _ = chain.points(q, tools, arm, robot.gravity_torques(q))
    points = points[:, 0] + NOISE * rng.normal(size=(rows, 3))
    names = [f"q{j}_rad" for j in range(1, chain.n + 1)] + ["x_mm", "y_mm", "z_mm"]
    lines = ["# kind: tracker", f"# robot: {ROBOT}", ",".join(names)]
    for row, (x, y, z) in zip(q, points, strict=True):
        instrument = 1e3 * np.array([y + 1.0, -x + 2.0, z - 0.5])  # turned by 90 degrees and moved
        lines.append(",".join(f"{v:.9f}" for v in [*row, *instrument]))
    path.write_text("\n".join(lines) + "\n")
    return path


def test_the_chain_agrees_with_pin(robot):
    chain = Chain(robot)
    q = np.random.default_rng(1).uniform(-2.0, 2.0, (20, chain.n))
    nothing = Deviation.none(chain.n)
    points, _, _ = chain.points(q, np.zeros((20, 1, 3)), nothing, np.zeros_like(q))
    for row, point in zip(q, points[:, 0], strict=True):
        robot.flange_matrix(row)
        assert point == pytest.approx(robot.data.oMi[chain.n].translation, abs=1e-12)


def test_every_derivative_agrees_with_differences(robot):
    chain = Chain(robot)
    rng = np.random.default_rng(2)
    q, torque = rng.uniform(-1.5, 1.5, (4, chain.n)), 50.0 * rng.normal(size=(4, chain.n))
    tools = np.broadcast_to(TOOL, (4, 1, 3))
    _, derivative, _ = chain.points(q, tools, Deviation.none(chain.n), torque)
    for k in range(8 * chain.n):
        step = np.zeros(8 * chain.n)
        step[k] = 1e-6
        ahead, _, _ = chain.points(q, tools, Deviation.of(step), torque)
        back, _, _ = chain.points(q, tools, Deviation.of(-step), torque)
        assert derivative[..., k] == pytest.approx((ahead - back) / 2e-6, rel=1e-6, abs=1e-7)


def test_a_fit_of_everything_reaches_the_noise_and_carries_to_another_run(tmp_path, robot):
    arm = arm_off_everywhere(robot.joint_count, 3)
    first = written(tmp_path / "a.csv", robot, arm, 300, 4)
    second = written(tmp_path / "b.csv", robot, arm, 60, 5)
    found = calibrate([first])
    assert found.here[NOTHING].heldout > 6 * NOISE
    assert 0.9 * NOISE < found.here[ELASTIC].fitted < 1.05 * NOISE  # 900 numbers, about 40 of them fitted
    assert found.here[ELASTIC].fitted < found.here[ELASTIC].heldout < 1.1 * NOISE
    there, _ = carried(found, second)
    assert there[ELASTIC].heldout < 1.2 * NOISE
    assert there[ELASTIC].heldout < there[GEOMETRY].heldout < there[NOTHING].heldout
    assert found.arms[ELASTIC].deviation.compliance[1] == pytest.approx(1e-5, rel=0.1)


def test_rows_far_off_are_set_aside_and_no_others(tmp_path, robot):
    path = written(tmp_path / "a.csv", robot, arm_off_everywhere(robot.joint_count, 6), 100, 7)
    readings = read([path], robot)
    readings.points[[10, 40], 0, 2] += 2e-3
    assert set(np.flatnonzero(~near(Chain(robot), readings))) == {10, 40}


def test_a_controller_that_counts_joint_3_against_the_horizon_is_understood(tmp_path, robot):
    path = written(tmp_path / "a.csv", robot, Deviation.none(robot.joint_count), 60, 8)
    lines = path.read_text().splitlines()
    for i in range(3, len(lines)):
        cells = [float(c) for c in lines[i].split(",")]
        cells[2] -= cells[1]
        lines[i] = ",".join(f"{c:.9f}" for c in cells)
    path.write_text("\n".join(lines) + "\n")
    found = calibrate([path])
    assert found.horizon == 1
    assert found.here[NOTHING].heldout < 1.2 * NOISE


def test_two_files_have_a_base_and_a_tool_each(tmp_path, robot):
    arm = arm_off_everywhere(robot.joint_count, 9)
    paths = [written(tmp_path / f"{k}.csv", robot, arm, 60, 10 + k) for k in range(2)]
    chain, readings = Chain(robot), read(paths, robot)
    readings.points[60:] += 0.3  # the instrument stood elsewhere
    fit = solve(chain, readings, ELASTIC)
    assert rms(residual(chain, readings, fit)[0]) < NOISE
    assert np.linalg.norm(fit.base[1, :3, 3] - fit.base[0, :3, 3]) > 0.2
    assert rms(residual(chain, readings, start(chain, readings))[0]) > 10 * NOISE


def test_held_out_errors_are_larger_than_fitted_ones_where_few_rows_carry_many_numbers(tmp_path, robot):
    path = written(tmp_path / "a.csv", robot, Deviation.none(robot.joint_count), 25, 12)
    left = errors(Chain(robot), read([path], robot), ELASTIC)
    assert left.fitted < 0.9 * NOISE
    assert left.heldout > 1.5 * left.fitted
