"""Recordings of real arms, solved; what is known of them from outside is compared."""

import numpy as np
import pytest

from app.calibration.sockets import sockets_page, solve_sockets
from app.calibration.solving import solve_file
from app.cli import run
from app.errors import TeachframeError
from app.recordings import read_table
from tests.data_folder import data_folder

#: What the printed part says of its two sockets, and how well an arm can be expected to see it [m].
SOCKETS_APART, PANDA_SEES, IIWA_SEES, PRINTED = 0.050, 0.003, 0.0002, 0.0005


@pytest.fixture(scope="module")
def sockets():
    folder = data_folder() / "mukca"
    return {name: solve_sockets(read_table(folder / f"run_{name}.csv")) for name in "abc"}


def test_the_four_touches_of_a_real_arm_are_solved_with_their_uncertainty():
    solved = solve_file(data_folder() / "za6_touch" / "run_points.csv")
    result = solved.result
    np.testing.assert_allclose(1e3 * result.tool_point, [18.638, -0.802, -93.336], atol=1e-3)
    assert result.mean == pytest.approx(1.014e-3, abs=1e-6) and (result.sigma_tool < 1e-3).all()
    assert solved.light.colour == "red" and len(solved.left_out) == 4


@pytest.mark.parametrize("name, tolerance", [("a", PANDA_SEES), ("b", PANDA_SEES), ("c", IIWA_SEES)])
def test_the_sockets_of_one_placement_come_out_as_far_apart_as_they_were_printed(sockets, name, tolerance):
    found = [distance for _, _, distance in sockets[name].distances()]
    assert len(found) >= 3
    assert np.abs(np.array(found) - SOCKETS_APART).max() < tolerance


def test_a_ball_on_the_flanges_axis_comes_out_there_within_what_a_printed_mount_is_good_for(sockets):
    for found in sockets.values():
        assert np.abs(found.result.tool_point[:2]).max() < PRINTED


def test_two_recordings_of_one_ball_agree_within_what_placements_scatter(sockets):
    a, b = sockets["a"].result, sockets["b"].result
    apart = (a.tool_point - b.tool_point) / np.hypot(a.sigma_tool, b.sigma_tool)
    assert np.abs(apart).max() < 3.0


def test_a_placement_left_out_is_predicted_almost_as_well_as_it_was_fitted(sockets):
    for found in sockets.values():
        rms = np.sqrt(np.mean(found.heldout**2))
        assert found.result.rms < rms < 1.03 * found.result.rms


def test_between_placements_the_tool_point_is_less_certain_than_single_touches_suggest(sockets):
    assert (sockets["a"].result.sigma_tool > 1.5 * sockets["a"].sigma_residual).all()


def test_the_command_line_solves_a_touch_recording(capsys):
    path = data_folder() / "mukca" / "run_c.csv"
    assert run(["solve", str(path)]) == 0
    assert "placement left out" in capsys.readouterr().out
    assert run(["solve", str(path), "--json"]) == 0
    assert '"tool_mm":[-0.03' in capsys.readouterr().out


def test_a_touch_recording_that_cannot_be_solved_says_why(tmp_path):
    head = "# kind: touch\n# robot: ur10e\n" + ",".join(f"q{j}_rad" for j in range(1, 7)) + ",target\n"
    for name, rows in (
        ("once", "0,-1,1,0,0,0,a\n0,-1,1,0,1,0,b\n"),
        ("axis", "0,-1,1,0,0,0,a\n0,-1,1,0,0,1,a\n"),
    ):
        path = tmp_path / f"{name}.csv"
        path.write_text(head + rows, encoding="utf-8")
        with pytest.raises(TeachframeError, match=str(path)):
            solve_sockets(read_table(path))
    path.write_text(head.replace("# robot: ur10e\n", "") + "0,0,0,0,0,0,a\n", encoding="utf-8")
    with pytest.raises(TeachframeError, match="# robot"):
        solve_sockets(read_table(path))


def test_the_page_names_every_placement_distance(sockets):
    assert "p1_h0-h1 49.87" in sockets_page(sockets["c"])
