"""A very long log: stretches of it, said so; what they teach is what the whole teaches."""

from __future__ import annotations

import numpy as np
import polars as pl
import pytest

from app.diagnosis.observations.joint_log import read_log
from app.diagnosis.observations.thinning import MOST_SAMPLES, STRETCH, stretches
from app.kinematics import load_robot
from app.recordings import read_table

ROWS = MOST_SAMPLES + 20_000
STEP = 0.002  # s
ARM = """<robot name="one"><link name="base"/><link name="arm"><inertial><origin xyz="0.2 0 0"/><mass value="2"/>
<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link><joint name="j1" type="revolute">
<parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
<limit lower="-3" upper="3" effort="50" velocity="5"/></joint>
</robot>"""


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    folder = tmp_path_factory.mktemp("long")
    (folder / "one.urdf").write_text(ARM)
    t = np.arange(ROWS) * STEP
    tau = np.random.default_rng(0).normal(size=ROWS)
    with (folder / "log.csv").open("wb") as file:
        file.write(b"# kind: motion\n")
        pl.DataFrame({"t_s": t, "q1_rad": np.sin(t), "tau1_Nm": tau}).write_csv(file, float_precision=6)
    return read_log(read_table(folder / "log.csv"), load_robot(str(folder / "one.urdf")))


def test_stretches_lie_within_the_log_and_apart():
    for total in (MOST_SAMPLES + 1, ROWS, 5_000_000, 7_654_321):
        first = stretches(total)
        assert first[0] == 0 and first[-1] + STRETCH == total
        assert np.all(np.diff(first) >= STRETCH)
        assert len(first) * STRETCH == MOST_SAMPLES
    assert not len(stretches(MOST_SAMPLES))


def test_samples_keep_their_times_and_line_numbers(log):
    assert len(log.t) == MOST_SAMPLES
    assert np.abs(log.t - (log.rows - log.rows[0]) * STEP).max() < 1e-9
    assert np.abs(log.q[:, 0] - np.sin(log.t)).max() < 1e-6
    assert log.t[-1] == pytest.approx((ROWS - 1) * STEP)


def test_it_is_said_and_borders_are_no_gaps(log):
    said = " ".join(map(str, log.notes))
    assert f"{ROWS} rows {MOST_SAMPLES} are worked on" in said
    assert "gap" not in said
    sizes = [s.stop - s.start for s in log.segments]
    assert sum(sizes) == MOST_SAMPLES and min(sizes) >= STRETCH
