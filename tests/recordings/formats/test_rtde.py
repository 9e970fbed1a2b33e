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


def _columns(path, names, *, mark=" ", end="\n", rows=30):
    """Column `name` of row i holds i + 0.001 * what NAMES says its number is; a name that is none of ours holds 99."""
    values = {name: 0.001 * k for k, name in enumerate(NAMES)}
    lines = [mark.join(names)]
    lines += [
        mark.join(f"{i + values[name]:.3f}" if name in values else "99" for name in names)
        for i in range(rows)
    ]
    path.write_bytes((end.join(lines) + end).encode())
    return read_table(path)


def _same(table):
    for name in ("actual_q_0", "actual_q_5", "actual_qd_3", "actual_current_2"):
        rtde, _, joint = name.rpartition("_")
        quantity = {"actual_q": "q", "actual_qd": "qd", "actual_current": "i"}[rtde] + str(int(joint) + 1)
        expected = np.arange(30) + 0.001 * NAMES.index(name)
        assert table.number(quantity) == pytest.approx(expected, abs=1e-9), name
    assert table.number("t") == pytest.approx(np.arange(30))


@pytest.mark.parametrize("mark", [" ", ",", ";", "\t"])
def test_a_variable_that_was_asked_for_twice_counts_once(tmp_path, mark):
    _same(_columns(tmp_path / "a.csv", [*NAMES, "actual_q_0", "actual_q_5", "timestamp"], mark=mark))


@pytest.mark.parametrize("mark", [" ", ",", ";", "\t"])
def test_columns_between_and_before_ours_are_passed_over(tmp_path, mark):
    names = ["time", "_id", *NAMES[:4], "payload", "robot_mode", *NAMES[4:], "speed_scaling"]
    _same(_columns(tmp_path / "a.csv", names, mark=mark))


def test_any_order_of_the_columns_is_the_same_log(tmp_path):
    for seed in range(3):
        _same(_columns(tmp_path / "a.csv", list(np.random.default_rng(seed).permutation(NAMES))))


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("rows", [30, 2000])  # beyond the first 64 KiB too
def test_lines_may_end_as_any_machine_ends_them(tmp_path, end, rows):
    table = _columns(tmp_path / "a.csv", NAMES, end=end, rows=rows)
    assert len(table) == rows
    assert table.number("q3")[-1] == pytest.approx(rows - 1 + 0.001 * NAMES.index("actual_q_2"))


def test_lines_that_are_no_rows_end_the_reading_where_they_outnumber_the_rows(tmp_path):
    path = tmp_path / "a.csv"
    _columns(path, NAMES)
    with path.open("ab") as file:
        file.write(b"x\n" * 300_000)
    with pytest.raises(InputError, match="rows that do not fit the header"):
        read_table(path)
