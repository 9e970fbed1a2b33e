"""Small parts of real recordings, learnt alone and carried to the rest: no worse than an ordinary calibration."""

import random

import numpy as np
import pytest

from app.diagnosis.kinematic.diagnose import diagnose
from app.diagnosis.kinematic.judging import judged
from app.diagnosis.kinematic.regions import regions
from app.diagnosis.model import ModelEffect, SavedModel, Taught, model_of
from app.diagnosis.models.kinematic import candidates
from app.diagnosis.models.kinematic.saved import held_terms
from app.diagnosis.models.kinematic.situation import situation_for
from app.diagnosis.models.kinematic.terms import effects
from app.diagnosis.observations.pose_reading import read_static
from app.recordings import read_table
from app.recordings.arm import robot_for
from benchmarks._program import without
from benchmarks.real_parts import Part, summary
from tests.data_folder import data_folder
from tests.diagnosis.kinematic.simulating import poses, term, tracker_rows, write_tracker

#: Recording, rows, where a stretch begins (None: spread over the recording), and what of the error of base and tool
#: may be left on the rest: a tenth more than an ordinary calibration of these rows leaves there, where it is of use.
#: Each ends alike without any one of its rows: where two descriptions are as likely as each other, chance decides.
PARTS = [
    ("dualarm_tracker/right", 120, None, 0.34),
    ("iiwa7_tracker/run_b", 12, 105, 0.45),
    ("iiwa7_tracker/run_c", 60, 60, 0.45),
    ("ur10_tracker/run_a", 120, 700, 1.0),
    ("ur5_tracker/run_a", 12, None, 0.3),
]


def parted(name, size, start):
    """The part's table and the rest's."""
    table = read_table(data_folder() / f"{name}.csv")
    lines = table.rows.tolist()
    own = set(random.Random(3).sample(lines, size) if start is None else lines[start : start + size])
    learnt = without(table, [line for line in lines if line not in own])
    return learnt, without(table, sorted(own))


@pytest.mark.parametrize(("name", "size", "start", "left"), PARTS)
def test_a_part_carried_to_the_rest_is_no_worse_than_an_ordinary_calibration(name, size, start, left):
    learnt, rest = parted(name, size, start)
    robot = robot_for(learnt)
    model = model_of(diagnose(learnt, robot))
    found = judged(read_static(rest, robot), robot, model)
    assert found.after_quality.heldout_rms < left * found.before_quality.heldout_rms


def test_what_is_found_does_not_hang_on_what_was_asked_before(monkeypatch):
    """A law that had been taken out for a control came back at the end of the library; that changed what was found."""
    learnt, _ = parted("ur10_tracker/run_a", 120, 700)
    robot, every = robot_for(learnt), list(effects().items())
    found = diagnose(learnt, robot)
    shuffled = random.Random(2).sample(every, len(every))
    monkeypatch.setattr(candidates, "effects", lambda: dict(shuffled))
    again = diagnose(learnt, robot)
    assert again.after.fit_rms == pytest.approx(found.after.fit_rms, rel=1e-6)
    assert again.after.heldout_rms == pytest.approx(found.after.heldout_rms, rel=1e-6)
    shares = {f.family: f.share for f in found.families}
    assert {f.family: f.share for f in again.families} == pytest.approx(shares, abs=1e-6)


def test_what_an_instrument_gets_wrong_throughout_is_carried_and_a_step_is_not(arm, tmp_path):
    rng = np.random.default_rng(5)
    errors = {}
    for where in ({"body": "instrument"}, {"body": "instrument", "from_row": 40}):
        q = poses(arm, rng, 80)
        wrong = term("instrument_zero_shift", where, [4e-3])
        table = write_tracker(
            tmp_path / "a.csv", arm, q, tracker_rows(arm, q, [wrong], noise=0.02, rng=rng), noise=0.02
        )
        model = model_of(diagnose(table, arm))
        assert [e.effect for e in model.effects if e.named] == ["instrument_zero_shift"]
        q = poses(arm, rng, 80)
        same = [wrong] if "from_row" not in where else []
        again = write_tracker(
            tmp_path / "b.csv", arm, q, tracker_rows(arm, q, same, noise=0.02, rng=rng), noise=0.02
        )
        errors[len(where)] = judged(read_static(again, arm), arm, model).after_quality.heldout_rms
    assert max(errors.values()) < 0.025


def test_what_holds_near_the_taught_poses_is_left_out_elsewhere(arm):
    rng = np.random.default_rng(2)
    taught = poses(arm, rng, 60, span=0.5)
    wave = {"joint": 2, "driver": "own_angle", "order": 1}
    effect = ModelEffect("gear_eccentricity", wave, {"sin": 1e-3, "cos": 0.0}, False, False, 0, True)
    model = SavedModel("static", "arm", (effect,), taught=Taught(poses=taught.tolist(), rows="other"))
    near, far = poses(arm, rng, 40, span=0.5), poses(arm, rng, 40, span=2.0)
    assert held_terms(model, situation_for(arm, near), "these")
    assert not held_terms(model, situation_for(arm, far), "these")
    assert held_terms(model, situation_for(arm, far), "other")  # its own rows hold everything


def test_poses_are_halved_into_regions_of_one_size(arm):
    found = regions(poses(arm, np.random.default_rng(1), 64))
    assert np.bincount(found).tolist() == [8] * 8


def test_the_table_says_how_many_are_worse():
    found = [
        Part("one", 12, "spread", 0.1, 0.2),
        Part("one", 12, "stretch", 0.2, 0.1),
        Part("two", 20, "spread", 1, 1),
    ]
    assert summary(found)[-1] == ("all", "3", "1.00", "2.00", "1")
    assert [line[0] for line in summary(found)] == ["one", "two", "all"]
