"""Bad points files through the command line: one clear line that names file, row and column, and exit code 2."""

import os
import resource

import numpy as np
import pytest

from app.cli import run
from app.resources import STATIC

HEAD = "# kind: points\n# angles: ZYX\n"
COLUMNS = "role,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg\n"
SAMPLE = (STATIC / "samples" / "xiong2012_table1.csv").read_text(encoding="utf-8")
GOOD = "".join(line for line in SAMPLE.splitlines(keepends=True) if not line.startswith("# note"))
ONE_AXIS = "".join(
    f"touch,{1000 + 300 * np.cos(np.radians(a)):.2f},{300 * np.sin(np.radians(a)):.2f},800.00,{a},0,180\n"
    for a in (0, 30, 60, 90)
)

#: name -> (file's text, what the line must say)
CASES = {
    "missing column": (GOOD.replace(",b_deg", ",other"), ["row 6", "b_deg", "missing"]),
    "column without unit": (GOOD.replace("x_mm", "x"), ["row 6", "column x", "x_mm or x_m"]),
    "no role column": (GOOD.replace("role,", "what,"), ["row 6", "column role"]),
    "text in a number": (GOOD.replace("231.99", "2E1.9o"), ["row 8", "column y_mm", "'-2E1.9o'", "number"]),
    "nan": (GOOD.replace("1478.85", "nan"), ["row 8", "column z_mm", "'nan'", "a finite number"]),
    "infinite": (GOOD.replace("1478.85", "inf"), ["row 8", "column z_mm", "'inf'"]),
    "out of this world": (GOOD.replace("1478.85", "1e300"), ["row 8", "column z_mm", "100 km"]),
    "turned too often": (GOOD.replace("136.1", "1e9"), ["row 8", "column c_deg", "a few turns"]),
    "empty cell": (GOOD.replace("1478.85", ""), ["row 8", "column z_mm", "empty"]),
    "unknown role": (
        GOOD.replace("touch+origin", "touch+orgin"),
        ["row 10", "column role", "'orgin'", "origin"],
    ),
    "one touch": (HEAD + COLUMNS + "touch,1,2,3,4,5,6\n", ["row 4", "column role", "1 touch", "3"]),
    "two touches": (
        HEAD + COLUMNS + "touch,1,2,3,4,5,6\ntouch,1,2,3,4,50,6\n",
        ["rows 4 to 5", "column role", "2 touches", "3"],
    ),
    "no touch": (HEAD + COLUMNS + "x,1,2,3,4,5,6\n", ["row 4", "column role", "0 touches"]),
    "parallel axes": (
        HEAD + COLUMNS + ONE_AXIS,
        ["rows 4 to 7", "a_deg", "about one axis", "(0.00, 0.00, 1.00)"],
    ),
    "same orientation": (
        HEAD + COLUMNS + "touch,1,2,3,4,5,6\n" * 4,
        ["rows 4 to 7", "same orientation", "two different axes"],
    ),
    "unknown convention": (GOOD.replace("ZYX", "ZXY"), ["# angles", "'ZXY'", "ZYZ"]),
    "no convention": (GOOD.replace("# angles: ZYX\n", ""), ["# angles", "one of", "rotvec"]),
    "bad quaternion": (
        HEAD.replace("ZYX", "quaternion") + "role,x_mm,y_mm,z_mm,qw,qx,qy,qz\ntouch,1,2,3,0,0,0,0\n",
        ["row 4", "column qw", "length 0"],
    ),
    "bad reference": (GOOD.replace("[119.5, 0, 352]", "[119.5, 0]"), ["measured_tool_mm", "[x, y, z]"]),
    "joints without robot": ("role,q1_deg\ntouch,1\n", ["# robot"]),
    "unknown robot": ("# robot: nobody\nrole,q1_deg\ntouch,1\n", ["# robot", "'nobody'", "ur10e"]),
    "too few joints": ("# robot: ur10e\nrole,q1_deg\ntouch,1\n", ["row 2", "q2_deg"]),
    "a sliding unit on a turning joint": (
        "# robot: ur10e\nrole," + ",".join(f"q{j}_mm" for j in range(1, 7)) + "\ntouch,1,2,3,4,5,6\n",
        ["row 2", "q1_mm", "q1_deg or q1_rad"],
    ),
    "another kind": (GOOD.replace("kind: points", "kind: motion"), ["# kind", "'motion'", "points"]),
    "empty file": ("", ["row 1", "empty", "header"]),
    "header only": (HEAD + COLUMNS, ["no data rows"]),
    "short row": (GOOD.replace(",19,136.1", ",19"), ["row 8", "6 cells"]),
}


def solve(path, capsys, *more):
    code = run(["solve", str(path), *more])
    out, err = capsys.readouterr()
    return code, out, err


def assert_one_line(code, out, err, path, words):
    assert code == 2
    assert out == ""
    assert err.count("\n") == 1 and "Traceback" not in err and "internal fault" not in err
    assert str(path) in err
    for word in words:
        assert word in err, f"{word!r} is not in {err!r}"


@pytest.mark.parametrize("name", CASES)
def test_bad_points_files_give_one_line_that_names_the_place(name, tmp_path, capsys):
    text, words = CASES[name]
    path = tmp_path / "points.csv"
    path.write_text(text, encoding="utf-8")
    assert_one_line(*solve(path, capsys), path, words)


def test_a_binary_file_is_named_as_such(tmp_path, capsys):
    path = tmp_path / "points.csv"
    path.write_bytes(np.random.default_rng(1).bytes(4096))
    assert_one_line(*solve(path, capsys), path, ["row ", "binary"])


def test_a_text_file_in_another_encoding_is_named_as_such(tmp_path, capsys):
    path = tmp_path / "points.csv"
    path.write_bytes("# title: 工具\nrole,x_mm\n".encode("gb2312"))
    assert_one_line(*solve(path, capsys), path, ["row 1", "UTF-8"])


@pytest.mark.parametrize("byte", [b"\0", b"0"])
def test_a_gigabyte_of_zeros_is_refused_without_being_read(byte, tmp_path, capsys):
    path = tmp_path / "zeros.csv"
    with path.open("wb") as file:
        file.write(byte * 70000)
        os.truncate(path, 1 << 30)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert_one_line(*solve(path, capsys), path, ["row 1"])
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown < 300_000, f"{grown} kB"


def test_a_file_that_is_not_there_is_named(tmp_path, capsys):
    assert_one_line(*solve(tmp_path / "no.csv", capsys), tmp_path / "no.csv", ["no such file"])


def test_a_missing_stroke_is_named_with_what_it_should_be(tmp_path, capsys):
    path = tmp_path / "points.csv"
    path.write_text(
        "\n".join(line for line in GOOD.splitlines() if not line.startswith("z,")), encoding="utf-8"
    )
    words = ["column role", "'z'", "+Z from the origin"]
    assert_one_line(*solve(path, capsys, "--orientation", "zx"), path, words)


def test_one_bad_file_among_several_does_not_stop_the_others(tmp_path, capsys):
    bad = tmp_path / "bad.csv"
    bad.write_text(CASES["nan"][0], encoding="utf-8")
    good = STATIC / "samples" / "xiong2012_table1.csv"
    code = run(["solve", str(good), str(bad), str(good), "--json"])
    out, err = capsys.readouterr()
    assert code == 2
    assert len(out.splitlines()) == 2 and err.count("\n") == 1 and str(bad) in err
