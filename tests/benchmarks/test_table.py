"""The benchmark table: what it says of a row, and which files it runs. No times are asserted."""

import pytest

from benchmarks.__main__ import chosen, figure, line, subjects, table
from benchmarks.rows import Row


def test_a_peer_that_takes_longer_reads_as_times_quicker():
    cells = line(Row("fit", 0.002, 0.4, "scipy", aim=0.05))
    assert cells == ("fit", "2 ms", "50 ms met", "400 ms", "200x", "scipy")


def test_a_missed_aim_is_said():
    assert line(Row("fit", 0.2, aim=0.05))[2].endswith("MISSED")


def test_a_peer_that_is_not_installed_leaves_a_dash():
    assert line(Row("fit", 0.2))[3:5] == ("-", "-")


def test_figures_that_are_no_seconds_keep_their_unit():
    assert figure(0.012, "mm") == "0.012 mm"


def test_every_subject_offers_run():
    import ast
    from pathlib import Path

    folder = Path(__file__).parents[2] / "benchmarks"
    for name in subjects():
        names = [
            n.name
            for n in ast.parse((folder / f"{name}.py").read_text()).body
            if isinstance(n, ast.FunctionDef)
        ]
        assert "run" in names, name


def test_part_of_a_name_selects_its_family_and_an_unknown_one_is_refused():
    there = ["static_fit", "static_search", "tool_solve"]
    assert chosen(["static"], there) == ["static_fit", "static_search"]
    assert chosen([], there) == there
    with pytest.raises(SystemExit, match="nothing called"):
        chosen(["nope"], there)


def test_the_table_lines_up():
    text = table([line(Row("a", 1e-6, 1e-3, "peer")), line(Row("a longer name", 2.0))])
    rows = text.splitlines()
    assert len({row.index("1 us") + 4 if "1 us" in row else row.index("2 s") + 3 for row in rows[2:]}) == 1
