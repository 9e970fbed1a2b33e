"""Two robots under one tracker."""

import numpy as np
import pytest

from app.calibration.base.run import run_base
from tests.calibration.base.cells import random_cells
from tests.calibration.base.files import codes, turn_error, write

TRIALS = 300
COVERED = (0.92, 0.98)  # of 300 trials
CLOSE_MM, CLOSE_RAD = 1.0, 3e-4
NOISE = 25e-6


def _pair(tmp_path, seed, refs=None, moved=None, **options):
    """Two files of two robots; `moved` (4, 4) is where the tracker went before the second, in mm."""
    cells = random_cells(seed, 2, noise=NOISE, noise_per_m=0.0)
    truth = cells.truth.copy()
    truth[:, :3, 3] *= 1e3
    paths = []
    for k in range(2):
        first, second = cells.first[k] * 1e3, cells.second[k] * 1e3
        fixed = np.zeros((0, 3)) if refs is None else refs
        towards = cells.towards[k] * 1e3
        if k == 1 and moved is not None:
            back = np.linalg.inv(moved)
            first, second, fixed, towards = (
                p @ back[:3, :3].T + back[:3, 3] for p in (first, second, fixed, towards)
            )
        fixed = fixed + np.random.default_rng(seed + k).normal(0, NOISE * 1e3, fixed.shape)
        extra = [f"0,{x:.4f},{y:.4f},{z:.4f},N{i}" for i, (x, y, z) in enumerate(fixed)]
        keys = ["noise_mm: 0.025", f"towards_workspace_mm: [{', '.join(f'{v:.2f}' for v in towards)}]"]
        path = tmp_path / f"r{k}.csv"
        write(path, first, second, keys=keys)
        if refs is not None:
            head, *rows = path.read_text().partition("z_mm\n")[2].splitlines()
            body = "\n".join(f"{row}," for row in [head, *rows])
            top = path.read_text().partition("axis,")[0]
            path.write_text(top + "axis,x_mm,y_mm,z_mm,name\n" + body + "\n" + "\n".join(extra) + "\n")
        paths.append(path)
    return paths, np.linalg.inv(truth[0]) @ truth[1]


def test_two_files_give_both_bases_and_their_relation(tmp_path):
    paths, truth = _pair(tmp_path, 1)
    out = run_base(paths).to_json()
    assert len(out["T_tracker_base"]) == 2
    angle, distance = turn_error(out["T_base1_base2"], truth)
    assert angle < CLOSE_RAD and distance < CLOSE_MM
    assert [a["robot"] for a in out["arcs"]] == [1, 1, 2, 2]
    assert out["relation"]["sigma_meeting_mm"] > 0


def test_one_file_has_one_frame_and_no_relation(tmp_path):
    paths, _ = _pair(tmp_path, 1)
    out = run_base(paths[:1]).to_json()
    assert np.shape(out["T_tracker_base"]) == (4, 4) and out["T_base1_base2"] is None


def test_the_miss_where_both_tools_meet_is_as_large_as_predicted(tmp_path):
    inside, at = 0, np.array([1500.0, 300.0, 200.0])
    for seed in range(TRIALS):
        paths, truth = _pair(tmp_path, 100 + seed)
        found = run_base(paths, meeting_mm=at).relation
        p2 = (np.linalg.inv(truth) @ [*at, 1.0])[:3]
        # base 1 sees the meeting point at `at`; robot 2 is sent there by the relation found
        sent = found.T_base1_base2.matrix[:3, :3] @ p2 / 1e3 + found.T_base1_base2.matrix[:3, 3]
        miss = sent - at / 1e3
        inside += miss @ np.linalg.solve(found.covariance_meeting, miss) < 7.814728  # chi-squared, 3, 95%
    assert COVERED[0] < inside / TRIALS < COVERED[1]


REFS = np.array([[500.0, 2000, 0], [3000, -1000, 300], [-2500, 800, 1200], [100, 100, 2500]])


def _motion(degrees, shift):
    a = np.radians(degrees)
    out = np.eye(4)
    out[:2, :2] = [[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]]
    out[:3, 3] = shift
    return out


def test_a_tracker_that_moved_is_named_and_brought_back_by_fixed_points(tmp_path):
    paths, truth = _pair(tmp_path, 2, refs=REFS, moved=_motion(3.0, [40.0, -20.0, 5.0]))
    result = run_base(paths)
    assert "tracker_moved" in codes(result)
    angle, distance = turn_error(result.to_json()["T_base1_base2"], truth)
    assert angle < CLOSE_RAD and distance < CLOSE_MM


def test_a_tracker_that_stood_still_raises_nothing(tmp_path):
    paths, _ = _pair(tmp_path, 3, refs=REFS)
    assert "tracker_moved" not in codes(run_base(paths))


def test_a_moved_tracker_without_enough_fixed_points_gives_no_relation_at_all(tmp_path):
    paths, _ = _pair(tmp_path, 4, refs=REFS[:2], moved=_motion(0.5, [3.0, 0, 0]))
    out = run_base(paths).to_json()
    assert out["T_base1_base2"] is None
    assert "tracker_moved" in {w["code"] for w in out["warnings"]}


def test_without_fixed_points_the_result_says_that_nothing_would_show_a_move(tmp_path):
    paths, _ = _pair(tmp_path, 5)
    assert any(
        "nothing in these recordings" in note for note in run_base(paths).to_json()["relation"]["notes"]
    )


def test_the_text_tells_where_the_tools_meet_and_how_far_they_miss(tmp_path):
    paths, _ = _pair(tmp_path, 6)
    text = run_base(paths, meeting_mm=(1000, 0, 500)).to_text()
    assert "both tools sent to (1000, 0, 500) mm of base 1 miss each other by" in text


def test_the_brought_back_relation_is_less_certain_than_the_direct_one(tmp_path):
    direct, _ = _pair(tmp_path, 7, refs=REFS)
    sure = run_base(direct).relation.sigma_meeting
    moved, _ = _pair(tmp_path, 7, refs=REFS, moved=_motion(2.0, [10.0, 0, 0]))
    assert run_base(moved).relation.sigma_meeting > sure * 1.001


@pytest.mark.parametrize("key", ["axis2_at_axis1_deg: x", "noise_mm: -1", "towards_workspace_mm: [1, 2]"])
def test_a_key_that_is_no_number_is_refused_by_its_name(tmp_path, key):
    from app.errors import CellValueError

    cells = random_cells(1, 1)
    with pytest.raises(CellValueError, match=key.partition(":")[0]):
        run_base([write(tmp_path / "a.csv", cells.first[0], cells.second[0], keys=[key])])
