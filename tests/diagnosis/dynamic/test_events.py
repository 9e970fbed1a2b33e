"""What happened in the middle of a joint log: its time to the row, its value, and nothing else beside it."""

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.kinematics import load_robot
from tests.diagnosis.dynamic.simulator import add_load, measure, swing, write

EXACT = "# inertials: exact\n"
#: Standard deviations an estimate may lie from the truth.
SIGMAS = 4.5


@pytest.mark.parametrize("since", [9.46, 13.01])
def test_a_load_taken_up_in_a_run_that_repeats_is_one_change(tmp_path, since):
    """The second round differs from the first by the load: that is no noise, and its edge belongs to one row."""
    robot, rng = load_robot("irb120"), np.random.default_rng([6, int(since)])
    run = swing(robot, rng, samples=2500, rate=125.0)  # rounds of ten seconds
    add_load(run, 1.9, (0.02, -0.03, 0.06), since=since)
    measure(run, rng, noise=0.01)
    found = diagnose(write(run, tmp_path / "taken.csv", header=EXACT), robot)
    assert [f.effect for f in found.findings] == ["payload_change"]
    assert found.findings[0].where["from_s"] == pytest.approx(since, abs=0.009)
    mass = next(p for p in found.findings[0].parameters if p.name == "mass")
    assert abs(mass.value - 1.9) < SIGMAS * mass.std
    assert 1.96 * mass.std < 0.03 * 1.9  # known to three hundredths
    assert found.noise.value == pytest.approx(float(np.sqrt(np.mean(run.noise**2))), rel=0.15)


def test_a_push_beside_the_flange_is_one_contact_with_its_force_and_its_moment(tmp_path):
    """By hand, at the tool: it swells and fades, and turns the flange as it acts beside it."""
    robot, rng = load_robot("iiwa7"), np.random.default_rng(61)
    run = swing(robot, rng, samples=3000, rate=100.0)
    force = np.array([30.0, -20.0, 25.0])
    lever = np.array([0.05, 0.1, -0.08])
    first, last = 12.0, 13.5
    for i in np.flatnonzero((run.t >= first) & (run.t < last)):
        wrench = np.concatenate([force, np.cross(lever, force)])
        run.torque[i] += (
            np.sin(np.pi * (run.t[i] - first) / (last - first)) * robot.jacobian(run.q[i]).T @ wrench
        )
    measure(run, rng, noise=0.01)
    found = diagnose(write(run, tmp_path / "push.csv", header=EXACT), robot)
    assert [f.effect for f in found.findings] == ["contact"]
    where, values = found.findings[0].where, {p.name: p.value for p in found.findings[0].parameters}
    assert (where["from_s"], where["to_s"]) == pytest.approx((first, last), abs=0.03)
    assert [values[f"force_{c}"] for c in "xyz"] == pytest.approx(force.tolist(), abs=1.0)
    assert [values[f"moment_{c}"] for c in "xyz"] == pytest.approx(np.cross(lever, force).tolist(), abs=0.3)
