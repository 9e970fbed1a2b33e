"""Figures that stand beside each other are of the same rows, and a certainty fits the value beside it."""

import pytest

from app.diagnosis.kinematic.diagnose import diagnose
from app.recordings import read_table
from app.recordings.arm import robot_for
from tests.data_folder import data_folder


def diagnosed(name):
    table = read_table(data_folder() / f"{name}.csv")
    return diagnose(table, robot_for(table, None))


def test_what_is_held_out_counts_the_rows_that_before_and_after_count():
    """A tracker of a network, with some two hundred rows far off: of these none may count in one figure alone."""
    found = diagnosed("ur5_bag_tracker/run_b")
    assert len(found.outliers) > 100
    assert found.after.fit_rms < 1.6  # mm; 1.8 to 3.8 where a refit's step was taken that left more
    assert found.after.heldout_rms > 0.9 * found.after.fit_rms  # 0.7 of it where each set its own rows aside
    assert found.families[-1].heldout_rms_after == pytest.approx(found.after.heldout_rms)


def test_a_value_of_many_standard_deviations_is_no_chance():
    """A length or an angle that is named for itself is a member of its family too: that it falls costs nothing then."""
    found = diagnosed("ur5_tracker/run_a")
    twist = next(f for f in found.findings if f.effect == "link_twist")
    assert abs(twist.parameters[0].value) > 20 * twist.parameters[0].std
    assert all(f.p_value < 0.01 for f in found.findings)
