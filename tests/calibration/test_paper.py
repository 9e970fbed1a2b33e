"""Table 1 of Xiong, Ye, Jiang (2012), worked through."""

import numpy as np
import pytest

from app.calibration.solvers.joint import fit_joint
from app.calibration.solvers.pairwise import delta, fit_pairwise, solve_pairwise
from app.geometry import convention
from app.recordings import read_table
from app.resources import STATIC

PRINTED_DIGITS = 5.001e-6  # the paper prints hundredths of a millimetre
RECOMPUTED = 1e-7
ORDER = 1e-4


@pytest.fixture(scope="module")
def touches():
    table = read_table(STATIC / "samples" / "xiong2012_table1.csv")
    rotations = convention("ZYX").to_rotation(table.numbers("abc"))
    return rotations[:4], table.numbers("xyz")[:4]


def test_the_papers_estimator_gives_the_papers_printed_tool_to_its_last_digit(touches):
    tool = fit_pairwise(*touches).tool
    np.testing.assert_allclose(tool, [0.11962, -0.00032, 0.35190], atol=PRINTED_DIGITS)


def test_equation_9_solves_equation_7(touches):
    rotations, positions = touches
    matrix = (rotations[:-1] - rotations[1:]).reshape(-1, 3)
    rhs = np.diff(positions, axis=0).reshape(-1)
    reference = np.linalg.lstsq(matrix, rhs, rcond=None)[0]
    np.testing.assert_allclose(solve_pairwise(rotations, positions), reference, atol=1e-13)
    assert delta(rotations, positions, reference) == pytest.approx(np.linalg.norm(matrix @ reference - rhs))


def test_the_order_of_the_touches_matters_to_the_paper_and_not_to_the_joint_fit(touches):
    rotations, positions = touches
    turned = np.array([1, 3, 0, 2])
    first, second = fit_joint(*touches).tool, fit_joint(rotations[turned], positions[turned]).tool
    np.testing.assert_allclose(first, second, atol=RECOMPUTED)
    moved = fit_pairwise(*touches).tool - fit_pairwise(rotations[turned], positions[turned]).tool
    assert np.linalg.norm(moved) > ORDER


def test_equation_19_as_printed_is_no_rotation_and_moves_the_tool_point(touches):
    """Row 3, column 2 is printed as sB sC; with it the tool comes out 0.19 mm off in y, with cB sC as printed."""
    table = read_table(STATIC / "samples" / "xiong2012_table1.csv")
    angles = table.numbers("abc")[:4]
    rotations, positions = touches
    printed = rotations.copy()
    printed[:, 2, 1] = np.sin(angles[:, 1]) * np.sin(angles[:, 2])
    assert np.abs(np.linalg.det(printed) - 1.0).max() > 0.1
    matrix = (printed[:-1] - printed[1:]).reshape(-1, 3)
    wrong = np.linalg.lstsq(matrix, np.diff(positions, axis=0).reshape(-1), rcond=None)[0]
    np.testing.assert_allclose(wrong, [0.1196110, -0.0005103, 0.3518760], atol=RECOMPUTED)
    assert abs(wrong[1] - -0.00032) > ORDER
