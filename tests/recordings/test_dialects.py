"""CSV as spreadsheets, loggers and other systems save it: the same numbers; and what stands for too much is refused."""

from __future__ import annotations

import time

import numpy as np
import pytest

from app.errors import InputError
from app.recordings import read_table
from app.recordings.arm import read_with_arm
from app.recordings.delimited import body

PLAIN = """# kind: points
# angles: ZYX
# title: "cell 4, torch"
# noise_mm: [0.1, 0.2]
role,x_mm,y_mm,a_deg
touch,1028.29,233.29,-156.2
touch,1118.69,-231.99,153.6
touch,1129.45,25,-175.1
"""
NUMBERS = np.array([[1.02829, 0.23329], [1.11869, -0.23199], [1.12945, 0.025]])


def semicolons(text):
    head, rows = text[: text.index("role")], text[text.index("role") :]
    return head + rows.replace(",", ";").replace(".", ",")


def padded(text, sign):
    """As a spreadsheet fills it up and quotes it."""
    lines = []
    for line in text.splitlines():
        if line.startswith("#"):
            quoted = '"' + line.replace('"', '""') + '"' if '"' in line else line
            lines.append(quoted + sign * 3)
        else:
            lines.append(line)
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    "data",
    [
        PLAIN.encode(),
        padded(PLAIN, ",").encode("utf-8-sig").replace(b"\n", b"\r\n"),
        padded(semicolons(PLAIN), ";").encode("utf-8-sig"),
        semicolons(PLAIN).encode(),
        (PLAIN[: PLAIN.index("role")] + PLAIN[PLAIN.index("role") :].replace(",", "\t")).encode(),
        padded(PLAIN, ",").replace("role,x_mm,y_mm,a_deg", "role,x_mm,y_mm,a_deg,,")
        .replace(".2\n", ".2,,\n").replace(".6\n", ".6,,\n").replace(".1\n", ".1,,\n").encode(),
        PLAIN.encode("utf-16"),
        padded(semicolons(PLAIN), ";").replace(";", "\t").encode("utf-16"),
        PLAIN.replace("\n", "\r").encode(),
    ],
    ids=["plain", "english", "german", "semicolons", "tabs", "filled up", "UTF-16", "Unicode text", "CR"],
)  # fmt: skip
def test_a_table_that_a_spreadsheet_saved_is_the_same_table(tmp_path, data):
    path = tmp_path / "points.csv"
    path.write_bytes(data)
    table = read_table(path)
    assert np.allclose(table.numbers(["x", "y"]), NUMBERS) and table.text("role") == ["touch"] * 3
    assert table.keys["kind"] == "points" and table.keys["title"] == "cell 4, torch"
    assert table.keys["noise_mm"] == [0.1, 0.2]
    assert table.resolution("a") == pytest.approx(np.radians(0.1))
    assert table.rows.tolist() == [6, 7, 8]


@pytest.mark.parametrize(
    "name, cells",
    [
        ("t_s", ["10.5", "10.75"]),
        ("t_ms", ["10500", "10750"]),
        ("t_us", ["10500000", "10750000"]),
        ("t_ns", ["1700000000500000000", "1700000000750000000"]),
        ("t_iso", ["2026-01-31T12:00:10.5", "2026-01-31T12:00:10.75"]),
        ("t_iso", ["2026-01-31 12:00:10.500", "2026-01-31 12:00:10.750"]),
        ("t_iso", ["2026-01-31T13:00:10.5+01:00", "2026-01-31T12:00:10.75Z"]),
    ],
)
def test_time_comes_in_any_unit(tmp_path, name, cells):
    path = tmp_path / "log.csv"
    path.write_text(f"{name},q1_rad\n{cells[0]},1\n{cells[1]},2\n")
    t = read_table(path).number("t")
    assert t[1] - t[0] == pytest.approx(0.25, abs=1e-6) and np.all(t > 10)


def test_a_moment_that_is_none_is_named(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text("t_iso,q1_rad\n2026-01-31T12:00:00,1\nyesterday,2\n")
    with pytest.raises(InputError, match=r"row 3, column t_iso: found 'yesterday'.*a moment such as"):
        read_table(path).number("t")


def test_large_files_are_read_as_numbers_and_say_the_same(tmp_path, monkeypatch):
    path = tmp_path / "log.csv"
    rows = "\n".join(f"{k * 0.01:.2f},{k % 7}.25,row {k}" for k in range(500))
    path.write_text(f"t_s,q1_rad,comment\n{rows}\n,bad,last\n")
    small = read_table(path)
    monkeypatch.setattr(body, "_LARGE", 100)
    large = read_table(path)
    for table in (small, large):
        with pytest.raises(InputError, match="row 502, column q1_rad: found 'bad'"):
            table.number("q1", missing=True)
        with pytest.raises(InputError, match="row 502, column t_s: the cell is empty"):
            table.number("t")
        assert np.isnan(table.number("t", missing=True)[-1])
    assert np.array_equal(small.tolerant("q1"), large.tolerant("q1"), equal_nan=True)
    assert small.resolution("q1") == large.resolution("q1") == 0.01
    assert large.text("comment")[3] == "row 3" and large.raw("q1")[1] == "1.25"


HEAD = b"# kind: motion\nt_s,q1_rad,tau1_Nm\n"


@pytest.mark.parametrize(
    "data, problem",
    [
        (HEAD + b'1,"' + b"a" * 30_000_000 + b'",3\n', "a line of over"),
        (HEAD + b'1,"' + b"a\n" * 10_000_000 + b'",3\n', "quote is not closed"),
        (HEAD + b"\n" * 30_000_000, "empty or remarks"),
        (HEAD + b"\r\n" * 15_000_000, "empty or remarks"),
        (HEAD + b"#\n" * 15_000_000, "empty or remarks"),
        (HEAD + b"," * 30_000_000, "a line of over"),
        (HEAD + (b"," * 99 + b"\n") * 300_000, "100 cells"),
        (HEAD.replace(b"\n", b"\r") + b"\r" * 30_000_000, "empty or remarks"),
        (b"# a: 1\n" * 4_000_000, "without a header row"),
    ],
    ids=[
        "one cell",
        "one cell of lines",
        "line ends",
        "CR LF",
        "remarks",
        "commas",
        "rows of commas",
        "CR",
        "keys",
    ],
)
def test_thirty_megabytes_of_nothing_are_refused_at_once(tmp_path, data, problem):
    path = tmp_path / "bomb.csv"
    path.write_bytes(data)
    began = time.process_time()
    with pytest.raises(InputError, match=problem):
        len(read_table(path))
    assert time.process_time() - began < 2.0


ALIASES = (
    "[" + ", ".join(f"&a{k} [{', '.join(['*a' + str(k - 1) if k else 'x'] * 10)}]" for k in range(9)) + "]"
)


@pytest.mark.parametrize(
    "value, problem",
    [
        (ALIASES, "alias"),
        ("&a [*a, *a]", "alias"),
        ("0x" + "f" * 60000, "a value of 60002 characters"),
        ("9" * 400, "cannot read"),
        ("!!python/object/apply:os.system [ls]", "a tag"),
        ("[[1, 2], [3, 4]]", "a list within a list"),
        ("{a: 1}", "a table"),
        ("[" * 900 + "]" * 900, "a list within a list"),
        ("[1, 2", "cannot read"),
    ],
    ids=lambda v: v[:12],
)
def test_a_key_that_is_more_than_a_scalar_or_a_flat_list_is_refused(tmp_path, value, problem):
    path = tmp_path / "points.csv"
    path.write_text(f"# title: {value}\nx_mm\n1\n")
    began = time.process_time()
    with pytest.raises(InputError) as caught:
        read_table(path)
    assert problem in str(caught.value) and "row 1, column title" in str(caught.value)
    assert time.process_time() - began < 1.0


@pytest.mark.parametrize(
    "text, value",
    [
        ("cell 4: the left one", "cell 4: the left one"),
        ("[1, 2.5]", [1, 2.5]),
        ("'a'", "a"),
        ("-3", -3),
        ("", None),
    ],
)
def test_scalars_flat_lists_and_plain_text_are_taken(tmp_path, text, value):
    path = tmp_path / "points.csv"
    path.write_text(f"# title: {text}\nx_mm\n1\n")
    assert read_table(path).keys["title"] == value


def log(folder, scale, kind="tau", unit="Nm"):
    """A log of the UR10e at rest in many poses, its torques gravity's, times `scale`."""
    from app.kinematics import load_robot

    robot, rng = load_robot("ur10e"), np.random.default_rng(2)
    q = rng.uniform(-1.5, 1.5, (80, 6))
    values = robot.gravity_torques(q) * scale
    names = ["t_s", *(f"q{j}_rad" for j in range(1, 7)), *(f"{kind}{j}_{unit}" for j in range(1, 7))]
    rows = [
        ",".join(f"{v:.6f}" for v in (0.01 * k, *a, *b))
        for k, (a, b) in enumerate(zip(q, values, strict=True))
    ]
    path = folder / "log.csv"
    path.write_text("# kind: motion\n# robot: ur10e\n" + ",".join(names) + "\n" + "\n".join(rows) + "\n")
    return path


def test_torques_that_are_currents_are_recognised_and_can_be_stated(tmp_path):
    from app.recordings.options import ReadOptions

    path = log(tmp_path, 1 / 12)
    with pytest.raises(InputError, match="about 1/12 of the description's: motor currents"):
        read_with_arm(path)
    table, _ = read_with_arm(path, None, ReadOptions(effort="A", drive_gain=(12.0,)))
    assert table.has("i1", "i6") and table.keys["drive_gain_Nm_per_A"] == [12.0] * 6
    assert read_with_arm(path, None, ReadOptions(effort="Nm"))[0].has("tau1")


@pytest.mark.parametrize("scale", [1.0, 1.3, 0.5, 2.0, 0.001])
def test_torques_of_a_wrong_scale_are_no_currents(tmp_path, scale):
    assert read_with_arm(log(tmp_path, scale))[0].has("tau1")


@pytest.mark.parametrize("turns", [2, -1])
def test_whole_turns_of_an_endless_joint_are_taken_off(tmp_path, turns):
    path = log(tmp_path, 1.0)
    lines = path.read_text().splitlines()
    for k in range(3, len(lines)):
        cells = lines[k].split(",")
        cells[6] = f"{float(cells[6]) + turns * 2 * np.pi + np.sign(turns) * 2 * np.pi:.6f}"
        lines[k] = ",".join(cells)
    before = read_with_arm(path)[0].number("q6")
    path.write_text("\n".join(lines) + "\n")
    table, _ = read_with_arm(path)
    assert np.allclose(np.angle(np.exp(1j * (table.number("q6") - before))), 0.0, atol=1e-5)
    assert np.abs(table.number("q6")).max() < 6.4 and "whole turns are taken off" in " ".join(table.notes)
