"""Point lists as tracker programs write them: dialects, units, names."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.calibration.base.naming import arcs_from_names
from app.errors import (
    CellValueError,
    FileFormatError,
    InputError,
    MissingColumnError,
    TeachframeError,
    UnitError,
)
from app.recordings import read_table
from app.recordings.point_lists import KIND, with_unit

SPATIAL_ANALYZER = """// SpatialAnalyzer 2023.2  Working Frame: A::WORLD
// Units: Millimeters
// Collection Group Target X Y Z
Cell Axis1 A1_-90 1500.1234 -2.5 610.0
Cell Axis1 A1_0 1400.5 10.25 611.0
Cell Axis1 A1_90 1300.75 20.5 612.0
Cell Axis2 A2_-30 100.0 200.0 300.0
Cell Axis2 A2_0 101.0 201.0 301.0
Cell Axis2 A2_30 102.0 202.0 302.0
"""
WITH_COLONS = """A::Robot1::J1_p45.0, 1.5, 2.25, -3.0, 0.01
A::Robot1::J1_m45.0, 2.5, 3.25, -4.0, 0.01
A::Robot1::J2_1, 0.5, 0.25, 0.75, 0.01
A::Robot1::J2_2, 0.6, 0.35, 0.85, 0.01
A::Robot1::REF 1, 9.5, 9.25, 9.75, 0.01
"""
GERMAN_LEICA = """Tracker Pilot;AT960;2026-03-01
Punkt-ID;X [mm];Y [mm];Z [mm];RMS
"A1_-15,5";1500,1234;-2,5;610,0;0,004
A1_0;1400,5;10,25;611,0;0,004
A1_15,5;1300,75;20,5;612,0;0,004
A2_1;100,0;200,0;300,0;0,003
A2_2;101,0;201,0;301,0;0,003
A2_3;102,0;202,0;302,0;0,003
"""
ENGLISH_LEICA = """Point ID,X,Y,Z
P1,1.5,2.5,3.5
"""
API_TABS = "API Radian Pro\nUnit:\tm\n\nPoint Name\tX\tY\tZ\tTime\nAxis1_p10deg\t1.5\t0.25\t0.125\t10:00:01\n"
API_BRACKETS = "Name,X (mm),Y (mm),Z (mm)\nJoint1 -5.0,10.5,20.25,-30.125\n"


def _read(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "export.txt"
    path.write_bytes(text.encode(encoding))
    return read_table(path)


def test_spatial_analyzer_points_keep_their_full_names_and_their_rows(tmp_path):
    table = _read(tmp_path, SPATIAL_ANALYZER)
    assert table.kind == KIND and "SpatialAnalyzer" in table.keys["source"]
    assert table.text("name")[0] == "Cell::Axis1::A1_-90"
    np.testing.assert_allclose(table.numbers("xyz")[0], [1.5001234, -0.0025, 0.61])
    assert table.rows.tolist() == [4, 5, 6, 7, 8, 9]


@pytest.mark.parametrize(
    "line, name",
    [
        ("A,Axis1,p1,100.1,200.2,300.3", "A::Axis1::p1"),
        ("Axis1 p1 100.1 200.2 300.3", "Axis1::p1"),
        ("p1,1.001000000000e+02,2.002e+02,3.003e+02", "p1"),
        ('"A","Axis 1","p 1",100.1,200.2,300.3', "A::Axis 1::p 1"),
        ("A,Axis1,p1,100.1,200.2,300.3,0.012,0.013,0.020,03/05/2019 10:11:12", "A::Axis1::p1"),
    ],
)
def test_every_naming_of_spatial_analyzer_is_read_with_the_unit_of_its_axis_comment(tmp_path, line, name):
    other = line.replace("p1", "p2").replace("p 1", "p 2")
    head = "// SpatialAnalyzer 2019.02.14\n// Frame: A::WORLD\n// X (mm), Y (mm), Z (mm)\n"
    table = _read(tmp_path, f"{head}{line}\n{other}\n")
    assert table.text("name")[0] == name
    np.testing.assert_allclose(table.numbers("xyz")[0], [0.1001, 0.2002, 0.3003])


def test_names_joined_by_colons_and_trailing_columns_are_understood_once_the_unit_is_said(tmp_path):
    table = _read(tmp_path, WITH_COLONS)
    with pytest.raises(UnitError, match="x_mm or x_m"):
        table.numbers("xyz")
    np.testing.assert_allclose(with_unit(table, "m").numbers("xyz")[1], [2.5, 3.25, -4.0])
    np.testing.assert_allclose(with_unit(table, "mm").numbers("xyz")[1], [0.0025, 0.00325, -0.004])


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("Cell Axis1 12 1.5 2.5 3.5", "Cell::Axis1::12"),
        ("Axis1 7 1.5 2.5 3.5 0.01", "Axis1::7"),
        ("Target 1.5 2.5 3.5 0.01 0.01", "Target"),
        ("12 1.5 2.5 3.5", "12"),
        ("Cell, Axis1, P4, 1.5, 2.5, 3.5", "Cell::Axis1::P4"),
    ],
)
def test_a_target_that_is_a_number_belongs_to_the_name_and_uncertainties_do_not(tmp_path, line, name):
    table = _read(tmp_path, f"// Units: m\n{line}\n")
    assert table.text("name") == [name]
    np.testing.assert_allclose(table.numbers("xyz"), [[1.5, 2.5, 3.5]])


def test_semicolons_with_decimal_commas_and_a_preface_are_understood(tmp_path):
    table = _read(tmp_path, GERMAN_LEICA)
    assert "Leica" in table.keys["source"]
    np.testing.assert_allclose(table.numbers("xyz")[0], [1.5001234, -0.0025, 0.61])
    assert table.rows[0] == 3


def test_a_german_code_page_is_read_too(tmp_path):
    text = GERMAN_LEICA.replace("Tracker Pilot", "Messung für Prüfung")
    assert len(_read(tmp_path, text, "cp1252")) == 6


def test_tabs_and_a_unit_in_a_line_of_its_own_are_understood(tmp_path):
    table = _read(tmp_path, API_TABS)
    assert "API" in table.keys["source"]
    np.testing.assert_allclose(table.numbers("xyz"), [[1.5, 0.25, 0.125]])


def test_a_unit_in_brackets_is_understood(tmp_path):
    np.testing.assert_allclose(_read(tmp_path, API_BRACKETS).numbers("xyz"), [[0.0105, 0.02025, -0.030125]])


def test_a_list_without_a_unit_is_refused_where_numbers_are_asked_for(tmp_path):
    with pytest.raises(UnitError):
        _read(tmp_path, ENGLISH_LEICA).numbers("xyz")


def test_own_files_are_not_taken_for_exports(tmp_path):
    for text in (
        "name,x_mm,y_mm,z_mm\na,1,2,3\n",
        "# kind: arcs\naxis,x_mm,y_mm,z_mm\n1,1,2,3\n",
        "target,x,y,z,q1_rad\na,1,2,3,0\n",
    ):
        assert _read(tmp_path, text).kind != KIND


@pytest.mark.parametrize(
    ("text", "error", "says"),
    [
        (GERMAN_LEICA.replace("1400,5", "viel"), CellValueError, "row 4.*X.*'viel'"),
        (GERMAN_LEICA.replace(";Z [mm]", ""), MissingColumnError, "Z"),
        ("Point ID;X [mm];Y [mm];Z [mm]\nA1;1\n", FileFormatError, "row 2: 2 cells"),
        ("Point ID;X [mm];Y [mm];Z [mm]\n", FileFormatError, "no data rows"),
        ("// only a comment\n", FileFormatError, "no data rows"),
        ("// SA\nCell A1 1.0 two 3.0\n", FileFormatError, "row 2"),
    ],
)
def test_what_cannot_be_read_is_refused_by_row_and_column(tmp_path, text, error, says):
    with pytest.raises(error, match=says):
        _read(tmp_path, text).numbers("xyz")


def test_signed_names_carry_angles_and_counted_ones_an_order(tmp_path):
    arcs = arcs_from_names(_read(tmp_path, GERMAN_LEICA)).arcs
    np.testing.assert_allclose(np.degrees(arcs[1].angles), [-15.5, 0.0, 15.5])
    assert arcs[2].angles is None


def test_p_and_m_stand_for_plus_and_minus_and_fixed_points_are_set_apart(tmp_path):
    arcs = arcs_from_names(with_unit(_read(tmp_path, WITH_COLONS), "m"))
    np.testing.assert_allclose(np.degrees(arcs.arcs[1].angles), [45.0, -45.0])
    assert list(arcs.references) == ["REF 1"]


def test_steps_of_ten_are_angles_and_a_dash_before_a_padded_number_is_no_minus(tmp_path):
    body = "".join(f"A1_{a} {a}.0 1 2\n" for a in (0, 10, 20, 30)) + "".join(
        f"A2-0{k} {k}.5 1 2\n" for k in (1, 2, 3)
    )
    arcs = arcs_from_names(_read(tmp_path, "// Units: mm\n" + body)).arcs
    np.testing.assert_allclose(np.degrees(arcs[1].angles), [0, 10, 20, 30])
    assert arcs[2].angles is None


def test_patterns_choose_the_axis_where_names_do_not_say_it(tmp_path):
    body = (
        "".join(f"ROB_FIRST_{a} {a}.0 1 2\n" for a in (-10, 0, 10))
        + "ROB_SECOND_1 1 2 3\nROB_SECOND_2 1 2 4\n"
    )
    table = _read(tmp_path, "// Units: mm\n" + body)
    with pytest.raises(CellValueError, match="no point's name says axis 1"):
        arcs_from_names(table)
    arcs = arcs_from_names(table, ["1=ROB_FIRST_*", "2=ROB_SECOND_*"]).arcs
    np.testing.assert_allclose(np.degrees(arcs[1].angles), [-10, 0, 10])
    with pytest.raises(InputError, match="AXIS=PATTERN"):
        arcs_from_names(table, ["first"])


def test_a_point_called_front_is_where_x_looks(tmp_path):
    text = SPATIAL_ANALYZER + "Cell Marks FRONT 5000.0 0.0 100.0\n"
    np.testing.assert_allclose(arcs_from_names(_read(tmp_path, text)).towards, [5.0, 0.0, 0.1])


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.sampled_from([SPATIAL_ANALYZER, GERMAN_LEICA, API_TABS]), st.data())
def test_a_damaged_export_is_refused_in_one_line_or_read(tmp_path, text, data):
    at = data.draw(st.integers(0, len(text) - 1))
    length = data.draw(st.integers(0, 12))
    junk = data.draw(st.text(max_size=6))
    path = tmp_path / "export.txt"
    path.write_text(text[:at] + junk + text[at + length :], encoding="utf-8", errors="replace")
    try:
        arcs_from_names(read_table(path))
    except TeachframeError as error:
        assert "\n" not in str(error)
