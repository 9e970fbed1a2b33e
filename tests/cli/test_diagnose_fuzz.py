"""Whatever happens to a recording's file, the answer is a diagnosis or one line: never a trace, never a fault."""

import numpy as np
import pytest

from tests.cli.running import teachframe

CASES = {"touch": 20, "tracker": 30, "motion": 5}
KINDS = {
    "touch": ("--effect", "joint_zero:joint=3"),
    "tracker": ("--effect", "joint_zero:joint=3", "--orientation"),
    "motion": ("--effect", "coulomb_friction:joint=2"),
}
SAMPLES = {"touch": "24", "tracker": "24", "motion": "400"}


def cell(rng):
    """Something that may stand in a cell and mostly should not."""
    odd = (
        "",
        "nan",
        "inf",
        "-",
        "1e400",
        "12,3",
        "abc",
        "0",
        "\x07",
        "１",
        '"',
        "1e308",
        "-1e-320",
        "0x10",
        "∞",
    )
    return str(rng.choice(odd))


def cells(rng, lines, start):
    for _ in range(rng.integers(1, 6)):
        row = int(rng.integers(start, len(lines)))
        parts = lines[row].split(",")
        parts[int(rng.integers(len(parts)))] = cell(rng)
        lines[row] = ",".join(parts)
    return lines


def column(rng, lines, start):
    """One column becomes constant, or goes, or takes another's place."""
    rows = [line.split(",") for line in lines[start - 1 :]]
    k, other = (int(v) for v in rng.integers(0, len(rows[0]), 2))
    how = rng.integers(4)
    for i, row in enumerate(rows):
        if how == 0:
            del row[k]
        elif how == 1 and i:
            row[k] = "0"
        elif how == 2:
            row[k], row[other] = row[other], row[k]
        elif how == 3 and i == 0:
            row[k] = row[k].rpartition("_")[0] + str(rng.choice(["_deg", "_mm", "_rad", "", "_furlong"]))
    return lines[: start - 1] + [",".join(row) for row in rows]


def rows(rng, lines, start):
    """Rows doubled, shuffled, or nearly all gone."""
    body = lines[start:]
    how = rng.integers(4)
    if how == 0:
        body = body[: int(rng.integers(0, 5))]
    elif how == 1:
        body = [body[i] for i in rng.permutation(len(body))]
    elif how == 2:
        body = body + body
    else:
        body = [body[0]] * len(body)
    return lines[:start] + body


def header(rng, lines, start):
    """A key that says something else."""
    said = (
        "# kind: points",
        "# kind: {}",
        "# robot: [",
        "# robot: nothing",
        "# noise_mm: -1",
        "# noise_mm: x",
        "# noise_mm: 1e9",
        "# noise_Nm: [1, 2]",
        "# payload_com_m: 3",
        "# resolution_deg: -2",
        "# drive_gain_Nm_per_A: 0",
        "#",
    )
    return [*lines[: start - 1], str(rng.choice(said)), *lines[start - 1 :]]


DAMAGES = (cells, cells, column, column, rows, header)


@pytest.mark.parametrize("kind", list(KINDS))
def test_a_damaged_recording_is_answered_or_refused_in_one_line(kind, tmp_path):
    good = tmp_path / "good.csv"
    made = teachframe(
        "simulate",
        good,
        "--robot",
        "ur10e",
        "--kind",
        kind,
        "--samples",
        SAMPLES[kind],
        *KINDS[kind],
        "--seed",
        "1",
    )
    assert made.code == 0, made.err
    original = good.read_text(encoding="utf-8").splitlines()
    start = next(i for i, line in enumerate(original) if not line.startswith("#")) + 1
    rng = np.random.default_rng(2024)
    bad = tmp_path / "bad.csv"
    for case in range(CASES[kind]):
        lines = DAMAGES[int(rng.integers(len(DAMAGES)))](rng, list(original), start)
        data = ("\n".join(lines) + "\n").encode("utf-8")
        if rng.random() < 0.15:
            data = data[: int(rng.integers(1, len(data)))]
        bad.write_bytes(data)
        said = teachframe("diagnose", bad, "--json")
        assert said.code in (0, 2), (case, said.err, lines[: start + 2])
        if said.code == 2:
            assert said.out == "" and len(said.err.splitlines()) == 1, (case, said)
            assert "bad.csv" in said.err, (case, said.err)
        else:
            assert said.out.count("\n") == 1
