"""An event's evidence by what a few rows change is that of the event weighed as a whole."""

import numpy as np
import pytest

from app.diagnosis.dynamic.event_sums import fits
from app.diagnosis.dynamic.event_white import changed, sums_of, white_parts
from app.diagnosis.models.dynamic.design import TorqueDesign
from app.diagnosis.models.dynamic.noise import SKIPPED, Whitener

ROWS, JOINTS, WIDE = 400, 2, 3


def log(seed: int):
    rng = np.random.default_rng(seed)
    whiteners = [Whitener(0.5, 0.8, 0.5), Whitener(0.2)]
    design = TorqueDesign(rng.normal(size=(ROWS, JOINTS)), whiteners, np.ones(JOINTS, bool))
    design.add([({j: rng.normal(size=(ROWS, 2))}, np.ones(2)) for j in range(JOINTS)])
    parts = [(white, ids) for white, ids in zip(design.white, design.at, strict=True)]
    return design, parts, design.white_y, {j: rng.normal(size=(ROWS, WIDE)) for j in range(JOINTS)}


def shaped(design, columns, shape):
    return white_parts({j: c * shape[:, None] for j, c in columns.items()}, design)


def between(first: int, last: int) -> np.ndarray:
    return ((np.arange(ROWS) >= first) & (np.arange(ROWS) < last)).astype(float)


@pytest.mark.parametrize(("first", "last"), [(100, 150), (2, 60), (380, ROWS)])
def test_products_of_an_event_are_those_of_its_columns_over_all_rows(first, last):
    design, parts, left, columns = log(1)
    found = sums_of(shaped(design, columns, between(first, last)), parts, left, 4)
    gram, cross, right = np.zeros((WIDE, WIDE)), np.zeros((WIDE, 4)), np.zeros(WIDE)
    for j, values in columns.items():
        white = design.whiteners[j](values * between(first, last)[:, None])
        assert len(white) == ROWS - SKIPPED
        gram += white.T @ white
        cross[:, parts[j][1]] += white.T @ parts[j][0]
        right += white.T @ left[j]
    assert found.gram == pytest.approx(gram, abs=1e-9)
    assert found.cross == pytest.approx(cross, abs=1e-9)
    assert found.right == pytest.approx(right, abs=1e-9)


@pytest.mark.parametrize(("first", "last"), [(96, 150), (104, 150), (100, 149), (100, 154), (100, 110)])
def test_moved_edges_change_products_by_the_rows_they_move_over(first, last):
    design, parts, left, columns = log(2)
    before, after = between(100, 150), between(first, last)
    white = shaped(design, columns, before)
    moved = changed(
        sums_of(white, parts, left, 4), white, shaped(design, columns, after - before), parts, left
    )
    anew = sums_of(shaped(design, columns, after), parts, left, 4)
    assert moved.gram == pytest.approx(anew.gram, abs=1e-9)
    assert moved.cross == pytest.approx(anew.cross, abs=1e-9)
    assert moved.right == pytest.approx(anew.right, abs=1e-9)


@pytest.mark.parametrize("lost", [0.0, -3.0])
def test_many_events_at_once_are_worth_what_each_is_worth(lost):
    rng = np.random.default_rng(3)
    half, own = rng.normal(size=(6, WIDE, 9)), rng.normal(size=(6, WIDE))
    block = half @ np.swapaxes(half, 1, 2)
    block[2] += lost * np.diag(
        [0.0, 0.0, 10.0]
    )  # rounding leaves some indefinite: the others are weighed all the same
    for gain, b, h in zip(fits(block, own), block, own, strict=True):
        m = b + np.eye(WIDE)
        assert gain == pytest.approx(
            0.5 * h @ np.linalg.solve(m, h) - 0.5 * np.linalg.slogdet(m)[1], abs=1e-9
        )
