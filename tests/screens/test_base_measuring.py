"""What the two-robot procedure measures where nothing moves is called so, and needs no switch."""

import pytest

from app.screens._base.run import Run
from tests.desk import until


def test_while_nests_are_measured_the_state_says_so(in_the_cell):
    """It said WAITING, with "hold ENABLING" in the message line, while nests were measured without the switch."""
    desk, view = in_the_cell
    seen, measure = [], Run.measure

    def told(run):
        seen.append(desk.live.read())
        return measure(run)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Run, "measure", told)
        desk.press("Run this step")
        desk.rests()
        assert len(seen) == len(view.run.cell.nests)
        assert {(now.how, now.state) for now in seen} == {("measuring", "measuring")}
        desk.press("Run this step")  # the zero position, where the arm stands already, or goes to
        with desk.holding():
            desk.rests()
    assert desk.drive.how == "standing"
    desk.does(lambda: view._start(whole=True))  # an arc
    until(lambda: desk.drive.how == "waiting", "an arm that has to turn to wait")


def test_a_stop_while_nests_are_measured_leaves_no_measuring_behind(in_the_cell):
    desk, view = in_the_cell
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("app.screens._base.run._REST", 5.0)
        desk.does(lambda: view._start(whole=False))
        until(lambda: desk.drive.how == "measuring", "the first nest")
        desk.live.stop()
        until(lambda: desk.drive.how == "stopped", "the stop")
        desk.live.release()
        until(lambda: desk.drive.how == "standing", "the release")
        assert not desk.drive.measuring
