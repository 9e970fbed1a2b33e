"""A log that is not what it says is refused in one line or warned about; it never gets a wrong name."""

from __future__ import annotations

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.observations.joint_log import read_log
from app.errors import InputError, MissingColumnError, UnitError
from app.kinematics import load_robot
from app.recordings import read_table
from tests.diagnosis.dynamic.simulator import measure, swing, write

ROWS = 1200


@pytest.fixture(scope="module")
def robot():
    return load_robot("ur10e")


def _run(robot, seed=5):
    rng = np.random.default_rng(seed)
    run = swing(robot, rng, samples=ROWS)
    measure(run, rng, 0.02)
    return run


def _refused(error) -> str:
    text = str(error.value)
    assert "\n" not in text and ".csv" in text
    return text


def test_time_that_runs_backwards_names_its_row(tmp_path, robot):
    run = _run(robot)
    run.t = run.t[::-1].copy()
    with pytest.raises(InputError, match="backwards") as error:
        read_log(write(run, tmp_path / "log.csv"), robot)
    assert "row 4" in _refused(error)


def test_a_few_rows_out_of_order_are_set_aside(tmp_path, robot):
    run = _run(robot)
    run.t[[100, 400]] = run.t[[90, 380]]
    log = read_log(write(run, tmp_path / "log.csv"), robot)
    assert len(log.dropped) == 2 and any("set aside" in note for note in log.notes)


def test_degrees_marked_as_radians_are_recognised(tmp_path, robot):
    run = _run(robot)
    run.q = np.degrees(run.q)
    with pytest.raises(UnitError, match="degrees marked as radians") as error:
        read_log(write(run, tmp_path / "log.csv"), robot)
    _refused(error)


def test_speeds_in_degrees_beside_angles_in_radians_are_recognised(tmp_path, robot):
    run = _run(robot)
    run.qd = np.degrees(run.qd)
    with pytest.raises(UnitError, match="degrees marked as radians"):
        read_log(write(run, tmp_path / "log.csv", speed=True), robot)


def test_positions_of_joints_that_are_changed_over_are_a_finding(tmp_path, robot):
    run = _run(robot)
    run.q = run.q[:, [0, 2, 1, 3, 4, 5]]
    found = diagnose(write(run, tmp_path / "log.csv"), robot)
    (finding,) = found.findings
    assert finding.effect == "wrong_convention"
    assert (finding.where["joint"], finding.where["source_joint"]) == (2, 3)
    assert found.after.fit_rms < 0.05 * found.before.fit_rms


def test_a_log_in_which_nothing_moves_is_refused(tmp_path, robot):
    run = _run(robot)
    run.q[:] = run.q[0]
    with pytest.raises(InputError, match="no joint moves"):
        read_log(write(run, tmp_path / "log.csv"), robot)


def test_a_dead_torque_sensor_is_told_and_names_nothing(tmp_path, robot):
    run = _run(robot)
    run.torque[:, 2] = 3.0
    found = diagnose(write(run, tmp_path / "log.csv"), robot)
    assert any("joint 3 is constant" in note for note in found.notes)
    assert not found.findings


def _currents(path, run, gains, header=""):
    text = write(run, path, digits=7).path.read_text()
    lines = text.splitlines()
    names = next(line for line in lines if line.startswith("t_s"))
    values = np.concatenate([run.t[:, None], run.q, run.torque / gains], axis=1)
    with path.open("w") as file:
        file.write("# kind: motion\n" + header)
        file.write(",".join(n.replace("tau", "i").replace("_Nm", "_A") for n in names.split(",")) + "\n")
        np.savetxt(file, values, fmt="%.7f", delimiter=",")
    return read_table(path)


def test_currents_without_gains_get_estimated_ones_that_are_marked(tmp_path, robot):
    gains = np.array([12.0, 12.0, 10.0, 9.0, 9.0, 9.0])
    run = swing(robot, np.random.default_rng(6), samples=ROWS)
    found = diagnose(_currents(tmp_path / "log.csv", run, gains), robot)
    assert any("ESTIMATED" in note for note in found.notes)
    assert not [f for f in found.findings if f.effect == "torque_constant"]


def test_currents_of_joints_that_carry_nothing_ask_for_gains(tmp_path, robot):
    run = _run(robot)
    run.torque[:, 5] = np.random.default_rng(7).normal(0, 1.0, ROWS)
    with pytest.raises(MissingColumnError, match="without drive gains") as error:
        diagnose(_currents(tmp_path / "log.csv", run, np.ones(6)), robot)
    assert "drive_gain_Nm_per_A" in _refused(error)


def test_stated_gains_make_torques_of_currents(tmp_path, robot):
    gains = np.array([12.0, 12.0, 10.0, 9.0, 9.0, 9.0])
    run = _run(robot)
    header = f"# drive_gain_Nm_per_A: {gains.tolist()}\n"
    log = read_log(_currents(tmp_path / "log.csv", run, gains, header), robot)
    np.testing.assert_allclose(log.y, run.torque, atol=1e-4)


@pytest.mark.parametrize("share", [0.05, 0.3])
def test_corrupt_rows_are_counted_and_name_nothing(tmp_path, robot, share):
    run = _run(robot)
    path = write(run, tmp_path / "log.csv", digits=7).path
    rng = np.random.default_rng(8)
    lines = path.read_text().splitlines()
    kinds = ("nan", "", "oops", "1e9", "-99999")
    for row in rng.choice(np.arange(2, len(lines)), int(share * ROWS), replace=False):
        cells = lines[row].split(",")
        cells[int(rng.integers(1, len(cells)))] = kinds[int(rng.integers(len(kinds)))]
        lines[row] = ",".join(cells)
    path.write_text("\n".join(lines) + "\n")
    found = diagnose(read_table(path), robot)
    assert not found.findings
    assert len(found.outliers) >= 0.95 * share * ROWS
    assert any("set aside" in note for note in found.notes)


def test_a_log_that_is_mostly_broken_is_refused(tmp_path, robot):
    run = _run(robot)
    run.torque[: int(0.7 * ROWS), 1] = np.nan
    with pytest.raises(InputError, match="rows are broken") as error:
        read_log(write(run, tmp_path / "log.csv"), robot)
    _refused(error)


def test_gaps_in_time_are_filtered_apart(tmp_path, robot):
    run = _run(robot)
    run.t[600:] += 5.0
    found = diagnose(write(run, tmp_path / "log.csv", digits=7), robot)
    assert not found.findings
    assert any("gap" in note for note in found.notes)


@pytest.mark.parametrize(
    ("key", "value"), [("noise_Nm", "much"), ("noise_Nm", "[1, 2]"), ("inertial_prior", "-1")]
)
def test_a_header_key_that_is_no_number_is_named(tmp_path, robot, key, value):
    run = _run(robot)
    with pytest.raises(InputError, match=key):
        diagnose(write(run, tmp_path / "log.csv", header=f"# {key}: {value}\n"), robot)
