"""Sizes that are promised (docs/limits.md): time grows with the number of rows and no faster."""

import time

import numpy as np
import pytest

from app.calibration.as_json import solved_json
from app.calibration.base.poses import base_from_poses
from app.calibration.solving import solve_file
from app.calibration.text import page
from app.geometry import CONVENTIONS
from tests.calibration.base.test_poses_outlier import recording
from tests.calibration.drawing import touches
from tests.hardening.endless import HEADS, KINDS_OF_END, endless
from tests.hardening.small import MOST_MEMORY, ran

#: Four times the rows may take so much longer: 4 for linear, 16 for quadratic.
MOST_GROWTH = 8.0


def points_file(path, count):
    rotations, positions = touches(count, 0.6, 1e-4, 3)
    angles = np.degrees(CONVENTIONS["ZYX"].from_rotation(rotations))
    rows = np.concatenate([1e3 * positions, angles], axis=1)
    lines = ["# kind: points", "# angles: ZYX", "role,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg"]
    lines += ["touch," + ",".join(f"{v:.4f}" for v in row) for row in rows.tolist()]
    path.write_text("\n".join(lines) + "\n")
    return path


def seconds(job):
    begun = time.process_time()
    job()
    return time.process_time() - begun


def test_four_times_the_touches_take_about_four_times_as_long(tmp_path):
    def job(path):
        solved = solve_file(path)
        page(solved)
        solved_json(solved)

    small, large = points_file(tmp_path / "a.csv", 3000), points_file(tmp_path / "b.csv", 12000)
    job(small)
    assert min(seconds(lambda: job(large)) for _ in range(2)) < MOST_GROWTH * min(
        seconds(lambda: job(small)) for _ in range(2)
    )


def test_ten_thousand_touches_of_three_orientations_are_told_without_all_their_pairs(tmp_path):
    path = points_file(tmp_path / "p.csv", 3)
    head, rows = path.read_text().splitlines()[:3], path.read_text().splitlines()[3:]
    path.write_text("\n".join([*head, *rows * 3334]) + "\n")
    found = ran("solve", "p.csv", "--json", folder=tmp_path)
    assert found.code == 0 and "too_alike" in found.out, found.err
    assert found.memory < MOST_MEMORY


def test_ten_thousand_tracked_poses_give_their_base(tmp_path):
    frames, _, points = recording(10_000, 3)
    points[77] += np.array([0.3, 0.0, 0.0])
    found = base_from_poses(frames.flange_rotations, frames.flange_positions, points)
    assert found.aside == (77,) and found.heldout_rms == pytest.approx(np.sqrt(3) * 1e-4, rel=0.05)


#: Bytes: more than is read at a time, and as much again as shows that it is not read to its end.
BEGINNING, ENDLESS = 2_000_000, 20_000_000
#: Ten times the bytes may take so much longer: what is endless is known after the first few.
MOST_LONGER = 5.0
ANY = 0.5  # s of the processor that a forked command takes on a slow machine before it reads anything


@pytest.mark.parametrize("kind", HEADS)
def test_what_has_no_end_is_refused_soon_and_in_little_memory(kind, tmp_path):
    path = tmp_path / "endless.csv"
    command, *options = HEADS[kind][2]
    for what in KINDS_OF_END:
        took = []
        for size in (BEGINNING, ENDLESS):
            path.write_bytes(endless(kind, what, size))
            found = ran(command, path, *options, folder=tmp_path)
            assert found.code == 2 and len(found.err.splitlines()) == 1, (what, found)
            assert found.memory < MOST_MEMORY, (what, found)
            took.append(found.seconds)
        assert took[1] < MOST_LONGER * (ANY + took[0]), (what, took)
