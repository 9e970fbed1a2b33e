"""Errors that remember the row before: no reason to say that something moved; a real move is still found."""

import numpy as np
import pytest
from scipy.signal import lfilter

from app.diagnosis.kinematic.diagnose import diagnose
from app.diagnosis.model import model_of
from tests.diagnosis.kinematic.simulating import NOISE_MM, poses, term, tracker_rows, write_tracker

MEMORY = 0.6
CLOCKED = ("base_shift", "base_drift", "tool_slip", "joint_slip", "joint_drift", "instrument_zero_shift")


def _recorded(arm, folder, seed, memory, terms=()):
    rng = np.random.default_rng(seed)
    q = poses(arm, rng, 60)
    points = tracker_rows(arm, q, terms, rng=rng, noise=0.0)
    fresh = rng.normal(0.0, NOISE_MM * 1e-3, points.shape)
    fresh[1:] *= np.sqrt(1.0 - memory**2)
    return write_tracker(folder / "r.csv", arm, q, points + lfilter([1.0], [1.0, -memory], fresh, axis=0))


@pytest.mark.parametrize("seed", range(10))
def test_errors_that_remember_are_no_step_and_no_drift(arm, tmp_path, seed):
    found = diagnose(_recorded(arm, tmp_path, [811, seed], MEMORY), arm)
    assert not [f for f in found.findings if f.effect in CLOCKED]


@pytest.mark.parametrize("memory", [0.0, MEMORY])
def test_a_base_that_moved_is_found_whether_errors_remember_or_not(arm, tmp_path, memory):
    moved = term("base_shift", {"body": "base", "from_row": 31}, [9e-4, -6e-4, 0.0])
    found = diagnose(_recorded(arm, tmp_path, 822, memory, (moved,)), arm)
    assert [f.effect for f in found.findings] == ["base_shift"]
    assert abs(found.findings[0].where["from_row"] - 31) <= 2


def test_on_a_sound_description_what_is_said_is_what_is_saved(arm, tmp_path):
    """However errors hang together: laws alone are elsewhere what they are here."""
    zero = term("joint_zero", {"joint": 3}, [2e-3])
    found = diagnose(_recorded(arm, tmp_path, 833, MEMORY, (zero,)), arm)
    (named,) = found.findings
    saved = [e for e in model_of(found).effects if e.effect == "joint_zero"]
    assert [named.effect, len(saved)] == ["joint_zero", 1]
    assert np.degrees(saved[0].parameters["offset"]) == pytest.approx(named.parameters[0].value, rel=1e-9)
