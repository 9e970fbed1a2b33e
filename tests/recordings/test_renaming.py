"""Plain CSV whose columns have names of their own: a mapping makes it a recording."""

from __future__ import annotations

import numpy as np
import pytest

from app.errors import InputError
from app.recordings import read_table
from app.recordings.options import ReadOptions, parse_mapping

ROWS = 5


def written(path, names, *, head="", mark=",", factor=1.0, decimal="."):
    """Column k of row i holds (i + k / 10) * factor."""
    rows = [
        mark.join(f"{(i + k / 10) * factor:.3f}".replace(".", decimal) for k in range(len(names)))
        for i in range(ROWS)
    ]
    path.write_text(head + "\n".join([mark.join(names), *rows]) + "\n")
    return path


def mapped(path, text="", **options):
    return read_table(path, ReadOptions(mapping=parse_mapping(text), **options))


@pytest.mark.parametrize(
    "names",
    [
        ["time", "pos1", "pos2", "eff1", "eff2"],
        ["time", "pos_0", "pos_1", "eff_0", "eff_1"],
        ["time", "pos[0]", "pos[1]", "eff[0]", "eff[1]"],
        ["time", "pos 1", "pos 2", "eff(1)", "eff(2)"],
    ],
)
def test_columns_that_are_counted_are_named_by_what_they_share(tmp_path, names):
    table = mapped(written(tmp_path / "log.csv", names), "q=pos:deg,tau=eff,t=time:ms")
    assert table.kind == "motion"
    assert table.names == ("t_ms", "q1_deg", "q2_deg", "tau1_Nm", "tau2_Nm")
    assert table.number("q2") == pytest.approx(np.radians(np.arange(ROWS) + 0.2))
    assert table.number("t") == pytest.approx(np.arange(ROWS) * 1e-3)


def test_a_line_in_the_header_says_the_same_and_the_command_line_goes_before_it(tmp_path):
    head = "# map: q=joint*_pos, t=stamp, tau=nothing\n"
    path = written(tmp_path / "log.csv", ["stamp", "joint1_pos", "joint2_pos", "m1", "m2"], head=head)
    table = mapped(path, "tau=m")
    assert table.number("q1") == pytest.approx(np.arange(ROWS) + 0.1)
    assert table.number("tau2") == pytest.approx(np.arange(ROWS) + 0.4)


def test_a_star_stands_for_the_joints_names_in_the_robots_order(tmp_path):
    path = written(tmp_path / "log.csv", ["t", "elbow.pos", "shoulder.pos"])
    table = mapped(path, "q=*.pos,t=t", joint_names=("shoulder", "elbow"), slides=(False, True))
    assert table.number("q1") == pytest.approx(np.arange(ROWS) + 0.2)
    assert table.columns["q2"].unit == "m"


def test_points_of_a_tracker_become_a_tracker_recording(tmp_path):
    path = written(tmp_path / "p.csv", ["j1", "j2", "East", "North", "Up"])
    table = mapped(path, "q=j:deg,x=East:mm,y=North:mm,z=Up:mm")
    assert table.kind == "tracker"
    assert table.number("z") == pytest.approx((np.arange(ROWS) + 0.4) * 1e-3)


def test_a_column_that_bears_the_new_name_already_makes_room(tmp_path):
    path = written(tmp_path / "log.csv", ["t_s", "q1_rad", "encoder1"])
    table = mapped(path, "q=encoder")
    assert table.number("q1") == pytest.approx(np.arange(ROWS) + 0.2)


def test_semicolons_and_decimal_commas_as_in_any_other_csv(tmp_path):
    path = written(tmp_path / "log.csv", ["time", "pos1"], mark=";", decimal=",")
    assert mapped(path, "q=pos:deg,t=time").number("q1") == pytest.approx(np.radians(np.arange(ROWS) + 0.1))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("q=angle", "unknown columns 'angle'"),
        ("q=pos:mm_s", "mm_s"),
        ("t=clock", "unknown column 'clock'"),
        ("q=gap", "counted 1, 3"),
        ("q", "--map"),
        ("q=(", "unknown columns"),
        ("q=*", "unknown columns"),
    ],
)
def test_a_mapping_that_does_not_fit_is_one_line(tmp_path, text, said):
    path = written(tmp_path / "log.csv", ["time", "pos1", "pos2", "gap1", "gap3"])
    with pytest.raises(InputError) as caught:
        mapped(path, text)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
