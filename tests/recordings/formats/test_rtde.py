"""RTDE logs: the maker's names become ours, broken rows are empty cells, nothing else gets in."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.errors import InputError
from app.recordings import read_table

NAMES = [
    "timestamp",
    *[f"{k}_{j}" for k in ("actual_q", "actual_qd", "actual_current", "target_moment") for j in range(6)],
]


def _write(path, mark=" ", rows=30, head=""):
    values = np.arange(rows)[:, None] + 0.01 * np.arange(len(NAMES))
    lines = [mark.join(NAMES), *[mark.join(f"{v:.4f}" for v in row) for row in values]]
    path.write_text(head + "\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize("mark", [" ", ",", ";"])
def test_names_of_the_maker_become_quantities_with_units(tmp_path, mark):
    table = read_table(_write(tmp_path / "robot.csv", mark))
    assert table.kind == "motion"
    assert {"t_s", "q1_rad", "qd6_rad_s", "i1_A"} <= set(table.names)
    assert not table.has("tau1"), "target_moment is a prediction"
    assert table.number("q1")[3] == pytest.approx(3.01)


def test_a_drive_gain_may_stand_above_the_header(tmp_path):
    path = _write(tmp_path / "robot.csv", head="# drive_gain_Nm_per_A: [12, 12, 10, 9, 9, 9]\n")
    table = read_table(path)
    assert table.keys["drive_gain_Nm_per_A"] == [12, 12, 10, 9, 9, 9]
    assert table.rows[0] == 3, "rows count as an editor does"


def test_a_broken_row_is_an_empty_one(tmp_path):
    path = _write(tmp_path / "robot.csv")
    lines = path.read_text().splitlines()
    lines[5] = lines[5][:20]
    lines[7] = lines[7].replace("6.0100", "oops")
    path.write_text("\n".join(lines))
    table = read_table(path)
    assert np.isnan(table.tolerant("q1")[[4, 6]]).all()
    assert np.isfinite(table.tolerant("q1")).sum() == 28


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(noise=st.binary(max_size=300), at=st.integers(0, 2000))
def test_whatever_stands_in_the_file_it_is_one_line_or_a_table(tmp_path, noise, at):
    data = _write(tmp_path / "robot.csv").read_bytes()
    (tmp_path / "robot.csv").write_bytes(data[:at] + noise + data[at:])
    try:
        table = read_table(tmp_path / "robot.csv")
        if table.has("t"):
            table.tolerant("t")
    except InputError as error:
        assert "\n" not in str(error)
