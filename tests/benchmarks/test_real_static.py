"""The comparison on real recordings: which files it takes, what it prints and what it writes."""

import pytest

import benchmarks.real_static as real_static
from app.kinematics import load_robot
from benchmarks._calibration.fit import ELASTIC, Errors
from benchmarks._program import without
from benchmarks._real_table import Line, Other, section
from tests.benchmarks.test_calibration import arm_off_everywhere, written


@pytest.fixture
def runs(tmp_path):
    """Two runs of one arm, and a file of another kind beside them."""
    robot = load_robot("ur10e")
    arm = arm_off_everywhere(robot.joint_count, 1)
    (tmp_path / "arm").mkdir()
    (tmp_path / "arm" / "points.csv").write_text("# kind: points\nrole,x_mm\n")
    return [written(tmp_path / "arm" / f"run_{k}.csv", robot, arm, 60, n) for n, k in enumerate("ab")]


def test_runs_of_one_arm_are_taken_together_and_other_kinds_left_alone(runs, monkeypatch):
    monkeypatch.setenv("TEACHFRAME_DATA", str(runs[0].parents[1]))
    assert real_static.recordings(()) == [runs]


def test_a_folder_without_recordings_is_said(tmp_path, monkeypatch):
    monkeypatch.setenv("TEACHFRAME_DATA", str(tmp_path))
    with pytest.raises(SystemExit, match="no touch or tracker recordings"):
        real_static.recordings(())


def test_the_ordinary_calibration_is_printed_alone_and_carried(runs, capsys):
    assert real_static.command([*map(str, runs), "--peer"]) == 0
    said = capsys.readouterr().out
    assert said.count("geometry and elasticity ") == 4  # each run on itself, and carried to the other
    assert "carried to run_b" in said and "program" not in said


def test_a_line_where_the_program_is_worse_stands_in_bold(runs):
    line = next(real_static.lines([runs], program=False))
    other = line.others[0]
    worse = Other(other.path, {ELASTIC: Errors(1e-4, 1e-4)}, (), 0.102)
    equal = Other(other.path, {ELASTIC: Errors(1e-4, 1e-4)}, (), 0.1009)
    text = section([Line(line.files, line.peer, None, (worse, equal))])
    assert "| **0.102** |" in text and "| 0.101 |" in text


def test_lines_set_aside_are_not_judged(runs):
    from app.recordings import read_table

    table = read_table(runs[0])
    left = without(table, [table.rows[3], table.rows[7]])
    assert len(left) == len(table) - 2
    assert table.rows[3] not in left.rows
    assert len(left.number("q1")) == len(left)
