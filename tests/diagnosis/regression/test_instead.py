"""Short ways to what the evidence says: a carried inverse, bounds of exchanges, widths without an eigenbasis."""

from itertools import pairwise

import numpy as np
import pytest

from app.diagnosis.regression.design import Design
from app.diagnosis.regression.evidence import Evidence, Group
from app.diagnosis.regression.inside import Inside
from app.diagnosis.regression.weighing import FEW_WIDTHS

ROUNDING = 1e-7
RIDGE = 1e-5  # nats that the ridge which keeps nearly equal columns apart is worth here
FEW = np.array([1.0, 25.0])
SIZES = (1, 2, 3, 1, 2, 1, 3, 1, 1, 2)


def evidence(seed: int, *, unit_noise: bool = True, widths: np.ndarray = FEW) -> Evidence:
    """Groups of one to three columns, some of them nearly alike."""
    rng = np.random.default_rng(seed)
    columns = rng.normal(size=(150, sum(SIZES)))
    columns[:, 8] = columns[:, 0] + 0.1 * columns[:, 8]
    columns[:, 12] = columns[:, 1] + 0.1 * columns[:, 12]
    response = columns @ rng.normal(size=sum(SIZES)) * 0.5 + rng.normal(size=150)
    design = Design(response, rng.normal(size=(150, 2)), 150)
    design.add(columns)
    ends = np.cumsum([0, *SIZES])
    groups = [Group(np.arange(a, b), 3.0, widths=widths) for a, b in pairwise(ends.tolist())]
    return Evidence(design, groups, unit_noise=unit_noise)


@pytest.mark.parametrize("unit_noise", [False, True])
def test_a_loss_is_the_difference_of_two_scores(unit_noise):
    e = evidence(1, unit_noise=unit_noise)
    now = {0: 1.0, 2: 25.0, 4: 1.0, 1: 25.0, 7: 1.0}
    for g, loss in e.losses(now).items():
        rest = {k: v for k, v in now.items() if k != g}
        assert loss == pytest.approx(e.score(now) - e.score(rest), abs=ROUNDING)


def test_an_inverse_that_is_carried_on_is_that_of_the_selection():
    e = evidence(2)
    e.inside(dict.fromkeys(range(9), 1.0))
    now = {0: 25.0, 1: 1.0, 2: 1.0, 4: 1.0, 5: 1.0, 6: 1.0, 7: 1.0, 8: 25.0}  # one dropped, two widened
    carried, anew = e.inside(now), Inside(e, now)
    assert carried.changes > 0
    assert carried.losses() == pytest.approx(anew.losses(), abs=ROUNDING)
    assert carried.residual == pytest.approx(anew.residual, abs=ROUNDING)


def test_the_best_of_few_widths_is_the_one_with_the_highest_score():
    e = evidence(3)
    now = {0: 1.0, 1: 25.0, 2: 1.0, 4: 1.0, 6: 25.0}
    inside = Inside(e, now)
    for g in now:
        rest = {k: v for k, v in now.items() if k != g}
        scores = {v: e.score({**rest, g: v}) - e.score(rest) + e.groups[g].penalty for v in FEW.tolist()}
        gain, gamma = inside.best_width(g)
        assert gamma == max(scores, key=lambda v: scores[v])
        assert gain == pytest.approx(max(scores.values()), abs=RIDGE)


def test_few_widths_and_an_eigenbasis_weigh_alike():
    few, many = evidence(4), evidence(4, widths=np.repeat(FEW, FEW_WIDTHS))
    now = {0: 1.0, 4: 25.0}
    rest = [g for g in range(10) if g not in now]
    assert few.gains(now, rest)[0] == pytest.approx(many.gains(now, rest)[0], abs=ROUNDING)


@pytest.mark.parametrize("unit_noise", [False, True])
def test_what_may_take_a_place_is_bounded_from_above_and_weighed_exactly(unit_noise):
    e = evidence(5, unit_noise=unit_noise)
    now = {0: 1.0, 1: 25.0, 2: 1.0, 6: 25.0}
    others = [g for g in range(10) if g not in now]
    instead, tight = e.instead(now), 0
    for g in now:
        rest = {k: v for k, v in now.items() if k != g}
        gains, _ = e.gains(rest, others)
        assert instead.gains(g, others)[0] == pytest.approx(gains, abs=ROUNDING)
        for k, gain in zip(others, gains, strict=True):
            assert k in instead.may(g, float(gain) - ROUNDING)
        least = float(np.median(gains))
        tight += len(instead.may(g, least)) < len(e.groups)
    assert tight  # a bound that lets all through would be none
