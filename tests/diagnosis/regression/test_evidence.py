"""The evidence against its definition, and what a search does with it."""

import numpy as np
import pytest
from scipy import stats

from app.diagnosis.regression.design import Absorbed, Design
from app.diagnosis.regression.evidence import Evidence, Group
from app.diagnosis.selection.change_points import Kind, Scanner
from app.diagnosis.selection.search import Search, open_among

ROUNDING = 1e-8


def problem(seed=0, rows=80, columns=7, free=3):
    rng = np.random.default_rng(seed)
    design = Design(rng.normal(size=rows), rng.normal(size=(rows, free)), rows)
    design.add(rng.normal(size=(rows, columns)))
    return design, [Group(np.array(c), 5.0) for c in ([0], [1, 2], [3], [4, 5, 6])]


def test_the_score_with_unit_noise_is_the_log_density_of_the_data():
    design, groups = problem()
    evidence = Evidence(design, groups, unit_noise=True)
    selection = {0: 2.0, 1: 0.5}
    x = design.explicit(np.array([0, 1, 2]))
    covariance = np.eye(len(x)) + x @ np.diag([2.0, 0.5, 0.5]) @ x.T
    alone = stats.multivariate_normal.logpdf(design.response, np.zeros(len(x)), np.eye(len(x)))
    together = stats.multivariate_normal.logpdf(design.response, np.zeros(len(x)), covariance)
    assert evidence.score(selection) == pytest.approx(together - alone - 10.0, abs=ROUNDING)


@pytest.mark.parametrize("unit_noise", [False, True])
def test_a_gain_is_the_difference_of_two_scores(unit_noise):
    design, groups = problem(1)
    evidence = Evidence(design, groups, unit_noise=unit_noise)
    now = {0: 1.0, 3: 4.0}
    gains, gammas = evidence.gains(now, [1, 2])
    for g, gain, gamma in zip([1, 2], gains, gammas, strict=True):
        with_it = evidence.score({**now, g: float(gamma)})
        assert with_it - evidence.score(now) == pytest.approx(gain, abs=ROUNDING)


def test_absorbed_parameters_are_projected_off_like_free_columns():
    rng = np.random.default_rng(2)
    rows, label = 60, np.arange(60) % 7
    y, free, x = rng.normal(size=rows), rng.normal(size=(rows, 2)), rng.normal(size=(rows, 4))
    entry = rng.uniform(0.5, 2.0, rows)
    dense = np.zeros((rows, 7))
    dense[np.arange(rows), label] = entry
    one = Design(y, free, rows, Absorbed(label, entry))
    other = Design(y, np.hstack([free, dense]), rows)
    one.add(x), other.add(x)
    assert one.matrix == pytest.approx(other.matrix, abs=ROUNDING)
    assert one.right == pytest.approx(other.right, abs=ROUNDING)
    assert one.dof == other.dof


def test_a_planted_group_is_taken_and_chance_is_not():
    rng = np.random.default_rng(3)
    x = rng.normal(size=(120, 40))
    y = rng.normal(size=120) + x[:, [5]] @ [1.0]
    design = Design(y, np.ones((120, 1)), 120)
    design.add(x)
    evidence = Evidence(design, [Group(np.array([c]), 5.0) for c in range(40)])
    found = Search(evidence, open_among(evidence, range(40))).climb({})
    assert set(found) == {5}
    weights, covariance = evidence.posterior(found).of(np.array([5]))
    assert abs(weights[0] - 1.0) < 4 * np.sqrt(covariance[0, 0])


def test_two_that_hide_each_other_are_found_as_a_pair():
    rng = np.random.default_rng(4)
    a = rng.normal(size=400)
    b = -a + 0.05 * rng.normal(size=400)
    others = rng.normal(size=(400, 20))
    design = Design(40 * a + 40 * b + 0.5 * rng.normal(size=400), np.ones((400, 1)), 400)
    design.add(np.column_stack([a, b, others]))
    evidence = Evidence(design, [Group(np.array([c]), 5.0) for c in range(22)])
    assert set(Search(evidence, open_among(evidence, range(22))).paired({})) == {0, 1}


@pytest.mark.parametrize("absorbed", [False, True])
@pytest.mark.parametrize("m", [60, 900])
def test_a_change_is_found_at_its_row(absorbed, m):
    rng = np.random.default_rng(5)
    k, row = 3, 37 * m // 60
    columns = rng.normal(size=(m, k, 2))
    y = 0.3 * rng.normal(size=(m, k)) + (columns @ [1.0, -2.0]) * (np.arange(m) >= row)[:, None]
    label = (np.arange(m)[:, None] % 5) * k + np.arange(k)
    groups = Absorbed(label.reshape(-1), np.ones(m * k)) if absorbed else None
    design = Design(y.reshape(-1), rng.normal(size=(m * k, 4)), m * k, groups)
    design.add(rng.normal(size=(m * k, 5)))
    evidence = Evidence(design, [Group(np.arange(5), 0.0)])
    change = Scanner(design, [Kind(columns, 30.0, "slip")]).best(evidence, {0: 1.0}, [], 0.0)[0]
    assert change.row == row and change.gain > 20
    masked = columns * (np.arange(m) >= row)[:, None, None]
    evidence.groups.append(Group(design.add(masked.reshape(m * k, 2)), 0.0, 30.0))
    exact = evidence.score({0: 1.0, 1: change.gamma}) - evidence.score({0: 1.0})
    assert change.gain == pytest.approx(
        exact - 7.0 - np.log(m), rel=1e-7
    )  # the evidence keeps a ridge of a billionth
