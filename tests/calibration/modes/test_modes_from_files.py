"""Every wizard mode solves a points file as well."""

import numpy as np
import pytest

from app.calibration.modes import modes
from app.calibration.solving import solve_file
from app.cli import run
from app.units import mm

WRITTEN = 1e-6  # the file holds nanometres and 1e-9 of a quaternion
FROM_FILES = [key for key, mode in modes().items() if mode.most_touches > 0]


def write(path, demo):
    lines = ["# angles: quaternion"]
    if "known_tool" in demo.options:
        lines.append(f"# known_tool_mm: {[float(v) for v in mm(np.array(demo.options['known_tool']))]}")
    lines.append("role,x_mm,y_mm,z_mm,qw,qx,qy,qz")
    for capture in demo.captures:
        pose = capture.T_base_flange
        lines.append(
            capture.role + "," + ",".join(f"{v:.9f}" for v in (*mm(pose.position), *pose.quaternion))
        )
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.mark.parametrize("key", FROM_FILES)
def test_a_modes_demonstration_written_to_a_file_is_solved_from_it(key, tmp_path):
    demo = modes()[key].demo(touches=modes()[key].default_touches, seed=1)
    solved = solve_file(write(tmp_path / "points.csv", demo), mode_key=key)
    np.testing.assert_allclose(solved.result.T_flange_tool.matrix, demo.T_flange_tool.matrix, atol=WRITTEN)
    assert solved.rounding.sigma_tool.max() < WRITTEN and not solved.gaps


@pytest.mark.parametrize("key", FROM_FILES)
def test_the_command_line_takes_the_mode_and_shows_its_page(key, tmp_path, capsys):
    demo = modes()[key].demo(touches=modes()[key].default_touches, noise=2e-4, seed=1)
    path = write(tmp_path / "points.csv", demo)
    assert run(["solve", str(path), "--mode", key, "--report", str(tmp_path / "sheet.html")]) == 0
    assert "tool point in the flange" in capsys.readouterr().out
    assert (tmp_path / "sheet.html").stat().st_size > 2000


def test_an_unknown_mode_is_bad_input(tmp_path, capsys):
    path = write(tmp_path / "points.csv", modes()["touch"].demo())
    assert run(["solve", str(path), "--mode", "tuch"]) == 2
    assert "did you mean touch" in capsys.readouterr().err
