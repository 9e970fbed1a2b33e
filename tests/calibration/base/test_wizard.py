"""The procedure as a state machine: the same states from the same actions, refusals with a reason."""

import numpy as np
import pytest

from app.calibration.base.wizard import BaseWizard, steps
from app.errors import ActionRefusedError
from tests.calibration.base.cells import random_cells


def _measured(cells, robots=2, moved_zero=0.0):
    """A wizard led to its end with the points of random cells."""
    wizard = BaseWizard(steps(robots, nests=False))
    while (step := wizard.step) is not None:
        k = step.robot - 1
        if step.kind == "zero":
            shift = moved_zero if step.key.endswith("zero2") else 0.0
            wizard = wizard.record(np.array([1.0, 2.0, 3.0 + shift]), sigma=20e-6)
        else:
            points = (cells.first if step.axis == 1 else cells.second)[k]
            span = np.linspace(-0.5, 0.5, len(points))
            for p, s in zip(points, span, strict=True):
                wizard = wizard.record(p, angle=float(s * _span(points)), sigma=20e-6)
        wizard = wizard.advance()
    return wizard


def _span(points):
    from app.geometry.circle import fit_axis

    return float(np.ptp(np.unwrap(fit_axis(points).azimuths)))


def test_the_plan_follows_the_document():
    plan = [(s.robot, s.kind, s.axis) for s in steps(2, nests=False)]
    one = [("zero", 0), ("turn", 1), ("zero", 0), ("turn", 2)]
    assert plan == [(1, *s) for s in one] + [(2, *s) for s in one]
    assert next(s.kind for s in steps(1)) == "nests"


def test_a_whole_procedure_gives_both_bases_and_their_relation():
    cells = random_cells(3, 2)
    bases, relation = _measured(cells).solve((None, None), ((1, 1), (1, 1)))
    truth = np.linalg.inv(cells.truth[0]) @ cells.truth[1]
    assert len(bases) == 2
    np.testing.assert_allclose(relation.T_base1_base2.matrix, truth, atol=2e-3)


def test_a_step_with_too_few_points_is_not_left():
    wizard = BaseWizard(steps(1, nests=False))
    with pytest.raises(ActionRefusedError, match="0 of at least 1"):
        wizard.advance()
    wizard = wizard.record(np.zeros(3)).advance().record(np.zeros(3))
    with pytest.raises(ActionRefusedError, match="1 of at least 3"):
        wizard.advance()


def test_actions_never_change_the_state_before():
    start = BaseWizard(steps(1, nests=False))
    after = start.record(np.ones(3))
    assert start.records == () and len(after.records) == 1
    assert after.undo().records == () and after.advance().index == 1 and after.index == 0


def test_undo_takes_back_records_then_steps_and_says_when_nothing_is_left():
    wizard = BaseWizard(steps(1, nests=False)).record(np.ones(3)).advance()
    assert wizard.undo().index == 0
    with pytest.raises(ActionRefusedError, match="nothing to undo"):
        wizard.undo().undo().undo()


def test_a_zero_measured_again_replaces_the_one_before():
    wizard = BaseWizard(steps(1, nests=False)).record(np.ones(3)).record(np.zeros(3))
    assert len(wizard.records) == 1 and not wizard.records[0].point.any()


def test_nothing_measured_and_nameless_fixed_points_are_refused():
    wizard = BaseWizard(steps(1))
    with pytest.raises(ActionRefusedError, match="name"):
        wizard.record(np.ones(3))
    with pytest.raises(ActionRefusedError, match="nothing was measured"):
        wizard.record(np.array([np.nan, 0, 0]), name="N1")


def test_a_reflector_that_does_not_come_back_to_zero_is_named():
    cells = random_cells(3, 2)
    bases, _ = _measured(cells, moved_zero=1e-3).solve((None, None), ((1, 1), (1, 1)))
    assert {"reflector_moved"} <= {w.code for b in bases for w in b.warnings}
    assert not _measured(cells).zero_warnings(1)


def test_a_result_before_the_end_is_refused_and_after_it_nothing_more_is_recorded():
    wizard = BaseWizard(steps(1, nests=False))
    with pytest.raises(ActionRefusedError, match="not every step"):
        wizard.solve((None,), ((1, 1),))
    done = _measured(random_cells(3, 1), robots=1)
    for action in (done.advance, lambda: done.record(np.zeros(3))):
        with pytest.raises(ActionRefusedError, match="every step is done"):
            action()


def test_the_summary_shows_what_is_done_and_what_comes_next():
    text = BaseWizard(steps(1, nests=False)).record(np.ones(3)).advance().summary()
    assert text.splitlines()[0].startswith("[x]") and text.splitlines()[1].startswith("[>]")
