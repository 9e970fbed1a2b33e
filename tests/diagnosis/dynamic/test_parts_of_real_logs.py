"""Short parts of real logs, cut out anywhere: an answer, whatever they hold, and no library's word."""

import warnings

import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.recordings import read_table
from app.recordings.arm import robot_for
from tests.data_folder import data_folder

#: Log, and the part of it that is learnt: events that fit nowhere else, commands that stand still but at an end, and
#: rows too few for masses and friction of their own size (with which the error was eight times the description's).
PARTS = [
    ("dvrk_psm_motion/run_b", 0.45575, 0.47576),
    ("lwa4p_motion/run_a", 0.6875, 0.9875),
    ("lwa4p_motion/run_b", 0.4309, 0.7309),
    ("lwa4p_motion/run_b", 0.4809, 0.7809),
    ("xl330_pendulum_motion/run_b", 0.198, 0.348),
]


@pytest.mark.parametrize(("name", "begin", "end"), PARTS)
def test_a_short_part_of_a_log_gets_an_answer(name, begin, end, tmp_path):
    path = data_folder() / f"{name}.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    comments = [line for line in lines if line.startswith("#")]
    heads, *rows = lines[len(comments) :]
    part = rows[int(begin * len(rows)) : int(end * len(rows))]
    for description in path.parent.glob("*.urdf"):
        (tmp_path / description.name).write_bytes(description.read_bytes())
    cut = tmp_path / "part.csv"
    cut.write_text("\n".join([*comments, heads, *part]) + "\n", encoding="utf-8")
    table = read_table(cut)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = diagnose(table, robot_for(table))
    assert found.after.fit_rms <= found.before.fit_rms
