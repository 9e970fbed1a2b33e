"""Short parts of real logs, cut out anywhere: an answer, whatever they hold, and no library's word."""

import warnings

import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.recordings import read_table
from app.recordings.arm import robot_for
from benchmarks._parting import Whole
from benchmarks.motion_parts import Part, part, section
from tests.data_folder import data_folder

#: Log, and the part of it that is learnt: events that fit nowhere else, commands that stand still but at an end, rows
#: too few for masses and friction of their own size (with which the error was eight times the description's), and a
#: stretch in which no piece could hold an event.
PARTS = [
    ("dvrk_psm_motion/run_b", 0.45575, 0.47576),
    ("lwa4p_motion/run_a", 0.6875, 0.9875),
    ("lwa4p_motion/run_b", 0.4309, 0.7309),
    ("lwa4p_motion/run_b", 0.4809, 0.7809),
    ("xl330_pendulum_motion/run_b", 0.198, 0.348),
    ("xl330_pendulum_motion/run_b", 0.5213927807963118, 0.8213927807963117),
]


@pytest.mark.parametrize(("name", "begin", "end"), PARTS)
def test_a_short_part_of_a_log_gets_an_answer(name, begin, end, tmp_path):
    whole = Whole.of(data_folder() / f"{name}.csv")
    cut = whole.part(whole.between(begin, end), tmp_path / "part.csv")
    table = read_table(cut)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = diagnose(table, robot_for(table))
    assert found.after.fit_rms <= found.before.fit_rms


#: Log, and the part of it that is learnt: it was carried to the rest 1.2 to 2 times worse than by least squares.
CARRIED = [
    ("gen3_joint_motion/run_a", 0.428, 0.578),
    ("so101_motion/run_a", 0.271, 0.571),
    ("ur10_motion/run_a", 0.542, 0.692),
]


@pytest.mark.parametrize(("name", "begin", "end"), CARRIED)
def test_a_part_carried_to_the_rest_is_no_worse_than_least_squares(name, begin, end):
    found = part(data_folder() / f"{name}.csv", begin, end)
    assert found.ours < 1.05 * found.peer
    assert found.ours < found.described


def test_the_documents_section_counts_what_carries_worse_than_the_description():
    found = [Part("a/run_a", 0.3, 1.0, 2.0, 1.5), Part("a/run_a", 0.3, 1.0, 0.5, 0.9)]
    text = section(found, "--seed 1 --each 2 ")
    assert "motion_parts --seed 1 --each 2 --write" in text and "1 of 2 parts" in text
    assert "| all | 2 | 1.00 | 2.00 | 1 |" in text
