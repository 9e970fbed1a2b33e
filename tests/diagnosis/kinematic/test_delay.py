"""Trackers that measure while the arm moves: the measurement and the angles are not of one moment."""

import numpy as np
import pytest

from app.diagnosis.kinematic.diagnose import diagnose
from app.diagnosis.kinematic.judging import judged
from app.diagnosis.model import model_of
from app.diagnosis.observations.pose_reading import read_static
from tests.diagnosis.kinematic.simulating import term, tracker_rows, write_tracker

NOISE = 0.05  # mm


def course(arm, seconds, seed=0):
    """(m, n) joints of a smooth motion through the workspace at times (m,) [s]."""
    rng = np.random.default_rng(seed)
    middle = 0.5 * (arm.lower + arm.upper).clip(-1.0, 1.0)
    n = len(middle)
    size, speed = rng.uniform(0.3, 0.7, (3, n)), rng.uniform(0.2, 0.9, (3, n))
    start = rng.uniform(0.0, 2.0 * np.pi, (3, n))
    return middle + np.sum(size * np.sin(speed * seconds[:, None, None] + start), axis=1)


def recorded(tmp_path, arm, delay, *, wrong=(), rate=20.0, rows=600, seed=0, stamps=None):
    """A recording in which every point was measured `delay` seconds before its row's angles."""
    t = np.arange(rows) / rate
    rng = np.random.default_rng(seed + 7)
    points = tracker_rows(arm, course(arm, t - delay, seed), wrong, noise=NOISE, rng=rng)
    q, shown = course(arm, t, seed), t
    if stamps is not None:
        shown = stamps(t)
        q = course(arm, shown, seed)
    return write_tracker(tmp_path / f"{seed}.csv", arm, q, points, noise=NOISE, seconds=shown)


def told(found):
    """Seconds that are said, in whichever way."""
    return sum(p.value for f in found.findings for p in f.parameters if p.name == "delay")


@pytest.mark.parametrize("delay", [-0.05, -0.004, 0.0015, 0.012, 0.06, 0.1, 0.2])  # rows are 0.05 s apart
def test_a_delay_is_told_with_its_value_and_carried_to_another_run(arm, tmp_path, delay):
    found = diagnose(recorded(tmp_path, arm, delay), arm)
    assert {f.effect for f in found.findings} <= {"delay", "wrong_convention"}
    assert told(found) == pytest.approx(delay, abs=2e-4 + 0.002 * abs(delay))
    assert found.after.heldout_rms < 1.1 * NOISE
    another = judged(read_static(recorded(tmp_path, arm, delay, seed=3), arm), arm, model_of(found))
    assert another.after_quality.heldout_rms < 1.1 * NOISE < 0.2 * another.before_quality.heldout_rms


def test_what_else_the_arm_has_is_found_beside_it(arm, tmp_path):
    wrong = [term("joint_zero", {"joint": 3}, [np.deg2rad(0.2)])]
    found = diagnose(recorded(tmp_path, arm, 0.035, wrong=wrong), arm)
    zero = next(f for f in found.findings if f.effect == "joint_zero")
    assert zero.where["joint"] == 3 and zero.parameters[0].value == pytest.approx(0.2, rel=0.05)
    assert told(found) == pytest.approx(0.035, abs=5e-4)


def test_rows_that_arrive_in_bursts_are_given_back_their_times(arm, tmp_path):
    def stamps(t):
        return np.ceil(t / 0.35 + 1e-9) * 0.35 + 1e-4 * (np.arange(len(t)) % 7)

    found = diagnose(recorded(tmp_path, arm, 0.0, stamps=stamps), arm)
    assert [f.effect for f in found.findings][:1] == ["wrong_convention"]
    assert "evenly" in found.findings[0].sentence
    assert found.after.heldout_rms < 0.05 * found.before.heldout_rms


def test_an_arm_that_moves_without_a_delay_has_none(arm, tmp_path):
    found = diagnose(recorded(tmp_path, arm, 0.0), arm)
    assert found.verdict == "clean" and not found.findings


@pytest.mark.parametrize("delay", [0.06, 0.1])
def test_a_delay_changes_nothing_where_the_arm_stops_for_each_row(arm, tmp_path, delay):
    model = model_of(diagnose(recorded(tmp_path, arm, delay), arm))
    seconds, rng = 30.0 * np.arange(40), np.random.default_rng(3)
    q = course(arm, seconds)
    points = tracker_rows(arm, q, noise=NOISE, rng=rng)
    stops = write_tracker(tmp_path / "stops.csv", arm, q, points, seconds=seconds)
    found = judged(read_static(stops, arm), arm, model)
    assert found.after_quality.heldout_rms == pytest.approx(found.before_quality.heldout_rms, rel=1e-6)
