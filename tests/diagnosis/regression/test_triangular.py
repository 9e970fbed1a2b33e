"""Small triangular systems."""

import numpy as np
import pytest

from app.diagnosis.regression.triangular import lower_solved


@pytest.mark.parametrize("shape", [(0,), (0, 3), (4, 0)])
def test_empty_systems_are_solved_without_a_word_on_standard_output(capfd, shape):
    lower = np.linalg.cholesky(np.eye(shape[0])) if shape[0] else np.zeros((0, 0))
    assert lower_solved(lower, np.zeros(shape)).shape == shape
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("transposed", [False, True])
def test_a_system_is_solved_as_written(transposed):
    rng = np.random.default_rng(3)
    lower = np.tril(rng.normal(size=(5, 5))) + 5.0 * np.eye(5)
    right = rng.normal(size=(5, 2))
    solved = lower_solved(lower, right, transposed=transposed)
    assert (lower.T if transposed else lower) @ solved == pytest.approx(right)
