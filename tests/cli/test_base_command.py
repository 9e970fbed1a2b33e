"""`teachframe base` as its user meets it: output, exit codes, one line for every mistake."""

import json

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.cli import run
from tests.calibration.base.files import cell, write

KEYS = {"format", "T_tracker_base", "T_base1_base2", "arcs", "warnings"}
ARC_KEYS = {"axis", "radius_mm", "arc_deg", "rms_mm", "sigma_axis_deg"}


@pytest.fixture
def good(tmp_path):
    first, second, _, _ = cell()
    return write(tmp_path / "good.csv", first, second)


def _base(capsys, *arguments):
    code = run(["base", *map(str, arguments)])
    out = capsys.readouterr()
    return code, out.out, out.err


def test_json_is_one_object_with_the_contracts_keys(capsys, good):
    code, out, err = _base(capsys, good, "--json")
    found = json.loads(out)
    assert code == 0 and err == "" and out.count("\n") == 1
    assert set(found) >= KEYS and found["format"] == "teachframe.base/1"
    assert np.shape(found["T_tracker_base"]) == (4, 4) and found["T_base1_base2"] is None
    assert [a["axis"] for a in found["arcs"]] == [1, 2] and set(found["arcs"][0]) >= ARC_KEYS


def test_two_files_give_a_list_of_two_and_the_relation(capsys, good):
    code, out, _ = _base(capsys, good, good, "--json")
    found = json.loads(out)
    assert code == 0 and np.shape(found["T_tracker_base"]) == (2, 4, 4)
    np.testing.assert_allclose(found["T_base1_base2"], np.eye(4), atol=1e-9)
    assert all({"code", "message"} <= set(w) for w in found["warnings"])


def test_the_table_shows_arcs_frame_and_uncertainty(capsys, good):
    code, out, _ = _base(capsys, good)
    assert code == 0
    for part in ("radius mm", "T_tracker_base", "±", "axes 1 and 2", "degrees"):
        assert part in out


def test_every_uncertainty_of_the_table_is_a_95_percent_interval(capsys, tmp_path):
    first, second, _, _ = cell()
    path = write(tmp_path / "a.csv", first, second, keys=["noise_mm: 0.02"])
    _, out, _ = _base(capsys, path, "--json")
    said = json.loads(out)["robots"][0]
    _, out, _ = _base(capsys, path)
    sure = next(line for line in out.splitlines() if "95% ±" in line).split()
    np.testing.assert_allclose([float(v) for v in sure[2:5]], 1.96 * np.array(said["sigma_mm"]), atol=6e-4)
    assert f"± {1.96 * said['sigma_axis_distance_mm']:.3f} mm apart" in out and "sigma" not in out


def test_a_description_gives_the_makers_frame_beside_it(capsys, tmp_path):
    first, second, _, _ = cell()
    path = write(tmp_path / "a.csv", first, second, keys=["robot: ur10e"])
    _, out, _ = _base(capsys, path, "--json")
    found = json.loads(out)["robots"][0]
    assert np.shape(found["T_tracker_maker"]) == (4, 4)
    step = np.array(found["T_base_maker"])
    assert step[2, 3] < -100  # the maker's origin lies on the mounting face, below axis 2


def test_a_description_that_is_not_there_is_a_warning_and_no_refusal(capsys, tmp_path):
    first, second, _, _ = cell()
    path = write(tmp_path / "a.csv", first, second, keys=["robot: nowhere.urdf"])
    code, out, _ = _base(capsys, path, "--json")
    assert code == 0 and "robot" in {w["code"] for w in json.loads(out)["warnings"]}


def test_an_export_runs_through_the_same_command(capsys, tmp_path):
    first, second, truth, _ = cell()
    lines = ["Punkt-ID;X [mm];Y [mm];Z [mm]"]
    for axis, points in ((1, first), (2, second)):
        lines += [
            f"A{axis}_{k};" + ";".join(f"{v:.4f}".replace(".", ",") for v in p)
            for k, p in enumerate(points, 1)
        ]
    path = tmp_path / "leica.csv"
    path.write_text("\n".join(lines))
    code, out, _ = _base(capsys, path, "--json")
    assert code == 0
    np.testing.assert_allclose(np.array(json.loads(out)["T_tracker_base"])[:3, 3], truth[:3, 3], atol=0.5)


HEAD = "# kind: arcs\naxis,x_mm,y_mm,z_mm\n"
ROWS = "".join(f"{axis},{k},{k * k},{axis * k}\n" for axis in (1, 2) for k in range(5))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "empty"),
        ("# kind: arcs\n", "header"),
        (HEAD, "no data rows"),
        ("# kind: arcs\naxis,x_mm,y_mm\n1,1,2\n", "z_m"),
        ("# kind: arcs\naxis,x,y,z\n1,1,2,3\n", "unit"),
        ("# kind: arcs\nx_mm,y_mm,z_mm\n1,2,3\n", "axis"),
        (HEAD + "1,1,2,three\n", "row 3, column z_mm"),
        (HEAD + "1,1,2,nan\n", "row 3, column z_mm"),
        (HEAD + "1,1,,3\n", "row 3, column y_mm: the cell is empty"),
        (HEAD + "1,1,2,inf\n", "row 3"),
        (HEAD + "1.5,1,2,3\n", "column axis"),
        (HEAD + "9,1,2,3\n", "column axis"),
        (HEAD + "1,1,2\n", "row 3: 3 cells"),
        (HEAD + "1,1,2,3\n1,2,3,4\n1,3,4,6\n", "no row of axis 2"),
        ("# kind: motion\nt_s,q1_rad\n0,0\n", "kind"),
        ("x_mm,y_mm,z_mm\n1,2,3\n", "kind"),
        ("# kind: arcs\n# axis1_sense: 2\naxis,x_mm,y_mm,z_mm\n" + ROWS, "axis1_sense"),
        (
            "# kind: arcs\n# towards_workspace_mm: [1, two, 3]\naxis,x_mm,y_mm,z_mm\n" + ROWS,
            "towards_workspace_mm",
        ),
        (
            "# kind: arcs\naxis,x_mm,y_mm,z_mm,angle_deg\n1,1,2,3,0\n1,2,3,4,\n1,3,4,6,9\n",
            "row 4, column angle_deg",
        ),
        (HEAD + ROWS + "0,1,2,3\n", "column name"),
        ("this is no table at all\n", "kind"),
        ("\x00\x01\x02", "binary"),
    ],
)
def test_bad_input_is_one_line_that_names_the_place_and_exit_code_2(capsys, tmp_path, text, says):
    path = tmp_path / "bad.csv"
    path.write_text(text)
    code, out, err = _base(capsys, path)
    assert code == 2 and out == ""
    assert err.count("\n") == 1 and says in err and "bad.csv" in err and "Traceback" not in err


def test_a_file_that_is_not_there_is_one_line_too(capsys, tmp_path):
    code, _, err = _base(capsys, tmp_path / "none.csv")
    assert code == 2 and err.count("\n") == 1 and "none.csv" in err


def test_a_refusal_names_the_file(capsys, tmp_path):
    path = tmp_path / "flat.csv"
    path.write_text(HEAD + "".join(f"{axis},{k},0,0\n" for axis in (1, 2) for k in range(5)))
    code, _, err = _base(capsys, path)
    assert code == 2 and "flat.csv" in err and "one line" in err


def _good_text():
    first, second, _, _ = cell(points=8)
    rows = [f"{a},{x:.3f},{y:.3f},{z:.3f}" for a, ps in ((1, first), (2, second)) for x, y, z in ps]
    return "# kind: arcs\n# towards_workspace_mm: [1, 2, 3]\naxis,x_mm,y_mm,z_mm\n" + "\n".join(rows) + "\n"


GOOD = _good_text()


@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_a_damaged_file_ends_in_a_result_or_in_one_line(tmp_path, capsys, data):
    at = data.draw(st.integers(0, len(GOOD) - 1))
    junk = data.draw(
        st.one_of(st.text(max_size=8), st.sampled_from([",", "\n", "1e308", "-", "nan", "#", '"']))
    )
    path = tmp_path / "fuzz.csv"
    path.write_text(
        GOOD[:at] + junk + GOOD[at + data.draw(st.integers(0, 40)) :], encoding="utf-8", errors="replace"
    )
    code, out, err = _base(capsys, path, "--json")
    if code == 0:
        assert json.loads(out)["format"] == "teachframe.base/1"
    else:
        assert code == 2 and err.count("\n") == 1, (code, err)
