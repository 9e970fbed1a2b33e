"""The CSV reader: what it takes, and one line with file, row and column for what it cannot."""

import os

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.errors import CellValueError, FileFormatError, InputError, MissingColumnError, UnitError
from app.recordings import read_table

GOOD = """# kind: points
# angles: ZYX
role,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg
touch,1,2,3,10,20,30
origin,4,5,6,-1,-2,-3
"""


def written(folder, text):
    path = folder / "points.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    return path


@pytest.fixture
def write(tmp_path):
    return lambda text: written(tmp_path, text)


def refused(path, kind=FileFormatError, quantity="x"):
    """The error of reading `quantity`, checked to be one line that names the file."""
    with pytest.raises(kind) as caught:
        read_table(path).number(quantity)
    assert str(path) in str(caught.value) and "\n" not in str(caught.value)
    return caught.value


def test_keys_text_and_numbers_come_out_in_si_units(write):
    table = read_table(write(GOOD))
    assert table.kind == "points" and table.keys["angles"] == "ZYX"
    assert table.text("role") == ["touch", "origin"]
    assert np.allclose(table.number("x"), [0.001, 0.004])
    assert np.allclose(table.number("a"), np.radians([10, -1]))
    assert table.rows.tolist() == [4, 5]
    assert len(table) == 2


@pytest.mark.parametrize(
    "text",
    [
        "\ufeff" + GOOD,
        GOOD.replace("\n", "\r\n"),
        "\ufeff" + GOOD.replace("\n", "\r\n"),
        GOOD.rstrip("\n"),
        GOOD.replace(",", " , "),
        GOOD.replace("touch,1", '"touch","1"'),
        GOOD.replace("role,", '"role",'),
    ],
    ids=["BOM", "CRLF", "BOM and CRLF", "no last line end", "spaces", "quotes", "quoted header"],
)
def test_what_editors_and_spreadsheets_do_to_a_file_changes_nothing(write, text):
    table = read_table(write(text))
    assert table.kind == "points"
    assert table.text("role") == ["touch", "origin"]
    assert np.allclose(table.number("x"), [0.001, 0.004])
    assert table.rows.tolist() == [4, 5]


@pytest.mark.parametrize(
    "text, rows",
    [
        ("x_mm\n1\n\n2\n", [2, 4]),
        ("x_mm\n\n\n1\n2\n\n", [4, 5]),
        ("x_mm\n1\n   \n2\n", [2, 4]),
        ("x_mm\n1\n2\n   ", [2, 3]),
        ("# kind: touch\n\nx_mm\n1\n# a remark\n2\n", [4, 6]),
        ("x_mm\r\n1\r\n\r\n2\r\n", [2, 4]),
    ],
)
def test_blank_lines_and_remarks_are_passed_over_and_rows_keep_their_line_numbers(write, text, rows):
    table = read_table(write(text))
    assert np.allclose(table.number("x"), [0.001, 0.002])
    assert table.rows.tolist() == rows


@pytest.mark.parametrize(
    "text, row",
    [
        ("x_mm\n1\noops\n3\n", 3),
        ("x_mm\n1\n\noops\n3\n", 4),
        ("# a: 1\n# b: 2\nx_mm\n1\n# remark\n\noops\n", 7),
        ("x_mm\r\n1\r\n\r\noops\r\n", 4),
        ('\ufeffx_mm,name\n1,"a, b"\noops,c\n', 3),
    ],
)
def test_the_row_named_is_the_line_an_editor_shows(write, text, row):
    error = refused(write(text), CellValueError)
    assert error.row == row and error.column == "x_mm"
    assert "'oops'" in str(error) and f"row {row}" in str(error)


@pytest.mark.parametrize(
    "cell", ["nan", "NaN", "inf", "-inf", "1e999", "1 2", "12 mm", "1_000", "0x1F", "--3", "١"]
)
def test_a_cell_that_is_no_finite_number_is_refused(write, cell):
    error = refused(write(f"x_mm,y_mm\n1,2\n{cell},4\n"), CellValueError)
    assert (error.row, error.column) == (3, "x_mm")


@pytest.mark.parametrize(
    "cell, value", [("1e3", 1.0), ("-.5", -0.0005), ("+2", 0.002), ("1E-3", 1e-6), (" 7 ", 0.007)]
)
def test_ways_to_write_a_number_are_taken(write, cell, value):
    assert read_table(write(f"x_mm,y_mm\n{cell},4\n")).number("x")[0] == pytest.approx(value)


def test_an_empty_cell_is_refused_unless_it_may_be_missing(write):
    path = write("x_mm,y_mm\n1,2\n,4\n")
    error = refused(path, CellValueError)
    assert error.row == 3 and "empty" in str(error)
    values = read_table(path).number("x", missing=True)
    assert values[0] == pytest.approx(0.001) and np.isnan(values[1])


def test_text_where_a_number_may_be_missing_is_still_refused(write):
    with pytest.raises(CellValueError, match="row 3"):
        read_table(write("x_mm,y_mm\n1,2\nn/a,4\n")).number("x", missing=True)


@pytest.mark.parametrize("name", ["x", "x_inch", "x_deg", "x_MM"])
def test_a_length_without_its_unit_or_with_a_wrong_one_says_which_would_be_right(write, name):
    error = refused(write(f"# kind: points\n{name},y_mm\n1,2\n"), UnitError)
    assert (error.row, error.column) == (2, name)
    assert "x_mm or x_m" in str(error)


def test_a_joint_without_unit_is_refused_too(write):
    with pytest.raises(UnitError, match="q1_deg or q1_rad"):
        read_table(write("q1,q2_deg\n1,2\n")).number("q2")


def test_a_missing_column_says_what_is_there_instead(write):
    error = refused(write("y_mm,z_mm\n1,2\n"), MissingColumnError)
    assert error.column == "x_mm or x_m" and "y_mm, z_mm" in str(error)


def test_unknown_columns_are_kept_and_ignored(write):
    table = read_table(write("x_mm,colour,remark\n1,red,\n"))
    assert table.number("x")[0] == pytest.approx(0.001)
    assert table.text("colour") == ["red"]


@pytest.mark.parametrize(
    "text, row, found",
    [
        ("x_mm,y_mm\n1,2\n3\n", 3, "1 cells"),
        ("x_mm,y_mm\n1,2,3\n3,4\n", 2, "3 cells"),
        ("x_mm,y_mm\n1\n1,2,3\n", 2, "1 cells"),  # too few and too many that add up
        ('x_mm,name\n1,"a"\n2,"b",3\n', 3, "3 cells"),
        ('x_mm,name\n1,"a, b"\n"2"\n', 3, "1 cells"),
    ],
)
def test_ragged_rows_are_named(write, text, row, found):
    error = refused(write(text))
    assert error.row == row and found in str(error) and "2 as in the header row" in str(error)


def test_a_ragged_row_in_the_middle_of_a_long_log_is_found(write):
    rows = ["1,2"] * 60000
    rows[30000], rows[40000] = "1", "1,2,3"
    error = refused(write("x_mm,y_mm\n" + "\n".join(rows) + "\n"))
    assert error.row == 30002


def test_a_quote_that_is_not_closed_is_named(write):
    error = refused(write('x_mm,name\n1,"a\n2,b\n'))
    assert error.row == 2 and "quote" in str(error)


def test_a_comma_inside_quotes_is_text(write):
    table = read_table(write('x_mm,comment\n1,"bent, slightly"\n'))
    assert table.text("comment") == ["bent, slightly"]


@pytest.mark.parametrize(
    "text, problem",
    [
        (b"", "empty"),
        (b"\n\n\n", "no header row"),
        (b"# kind: points\n", "no header row"),
        (b"x_mm,y_mm\n", "no data rows"),
        (b"x_mm,y_mm\n\n# nothing\n", "no data rows"),
        (b"x_mm,,y_mm\n1,2,3\n", "without a name"),
        (b"x_mm,x_mm\n1,2\n", "twice"),
        (b"x_mm,x_m\n1,2\n", "twice"),
        (b"# noise_mm: [1, 2\nx_mm\n1\n", "YAML"),
        (b"a" * 70000, "line without end"),
        (b"\x89PNG\r\n\x1a\n\x00\x00\x00\x0d", "binary"),
        (bytes(range(256)) * 20, "binary"),
        (b"x_mm\n1\n\x00\n", "binary"),
        (b"\xff\xfex\x00_\x00m\x00m\x00", "no data rows"),  # UTF-16
        (b"\xff\xfex\x00_\x00m\x00m", "UTF-16"),
    ],
    ids=lambda value: repr(value[:24]) if isinstance(value, bytes) else value,
)
def test_what_is_no_table_is_refused_in_one_line(write, text, problem):
    error = refused(write(text))
    assert problem in str(error), str(error)


@pytest.mark.parametrize(
    "text, row",
    [(b"x_mm,name\n1,\xe9\n", 2), (b"x_mm,name\n1,a\n2,b\n3,\xff\xfe\n", 4), (b"# \xff\nx_mm\n1\n", 1)],
)
def test_latin_1_text_is_named_by_its_row(write, text, row):
    error = refused(write(text))
    assert error.row == row and "UTF-8" in str(error)


def test_chinese_text_is_taken(write):
    table = read_table(write("# 备注: 焊枪\nx_mm,comment\n1,第一点\n"))
    assert table.text("comment") == ["第一点"]


def test_no_such_file_and_a_folder_are_refused(tmp_path):
    with pytest.raises(FileFormatError, match="no such file"):
        read_table(tmp_path / "nowhere.csv")
    with pytest.raises(FileFormatError):
        read_table(tmp_path)


@pytest.mark.parametrize("start", [b"", b"x_mm,y_mm\n1,2\n", b"# kind: touch\n" + b"x_mm\n" + b"1\n" * 50000])
def test_a_gigabyte_of_zeros_is_refused_without_being_read(tmp_path, start):
    path = tmp_path / "zeros.csv"
    path.write_bytes(start)
    os.truncate(path, 1_000_000_000)
    error = refused(path)
    assert "binary" in str(error)
    assert error.row == start.count(b"\n") + 1


@settings(deadline=None)
@given(
    st.lists(
        st.tuples(
            st.floats(-1e6, 1e6),
            st.text(st.characters(codec="utf-8", exclude_categories=["C", "Z"]), max_size=8),
        ),
        min_size=1,
        max_size=30,
    )
)
def test_whatever_was_written_is_read_back(tmp_path_factory, rows):
    folder = tmp_path_factory.mktemp("csv")
    lines = [f'{x!r},"{text.replace(chr(34), chr(34) * 2)}"' for x, text in rows]
    table = read_table(written(folder, "x_m,comment\n" + "\n".join(lines) + "\n"))
    assert np.array_equal(table.number("x"), [x for x, _ in rows])
    assert table.text("comment") == [text.strip() for _, text in rows]


@settings(deadline=None)
@given(st.binary(max_size=400))
def test_any_bytes_give_a_table_or_one_line(tmp_path_factory, data):
    path = written(tmp_path_factory.mktemp("bytes"), data)
    try:
        table = read_table(path)
        for quantity in ("x", "q1", "role"):
            if table.has(quantity):
                table.text(quantity)
        len(table)
    except InputError as error:
        assert "\n" not in str(error) and len(str(error)) < 700


@settings(deadline=None)
@given(st.text(max_size=200))
def test_any_text_below_a_good_header_gives_rows_or_one_line(tmp_path_factory, text):
    path = written(tmp_path_factory.mktemp("text"), "x_mm,y_mm\n" + text)
    try:
        assert len(read_table(path).number("x")) >= 1
    except InputError as error:
        assert str(path) in str(error)


@pytest.mark.parametrize(
    "cells, resolution", [(["44.8", "19", "-126.6"], 0.1), (["1", "20"], 1.0), (["1e-3", "2"], 1e-3)]
)
def test_the_resolution_of_written_digits_is_found(write, cells, resolution):
    table = read_table(write("a_deg\n" + "\n".join(cells) + "\n"))
    assert table.resolution("a") == pytest.approx(np.radians(resolution))
