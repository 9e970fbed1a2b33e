"""Two robots: the procedure can be stopped, what was found is exported and printed, and no truth goes with it."""

import json
import re

import numpy as np
import pytest

from app.session.actions import OpenCell
from app.simulation.tracker_cell import make_cell
from app.units import deg, mm
from tests.desk import until
from tests.standing_out import standing_out

SEED = 5


@pytest.fixture
def opened(sit_at, brisk):
    desk = sit_at(robot="irb120")
    desk.does(lambda: desk.context.do(OpenCell("irb120", "ur10e", SEED)))
    return desk


def sent(desk):
    return {found.name: found.content for found in desk.live.downloads()}


def test_a_procedure_is_stopped_where_it_is_and_goes_on_from_there(opened):
    desk, view = opened, opened.view("run")
    with desk.holding():
        desk.does(lambda: view._start(whole=True))
        assert "Stop the procedure" in desk.shown()
        until(lambda: len(view.run.wizard.records) > 2, "a few points")
        desk.press("Stop the procedure")
        stood = view.run.wizard.index, len(view.run.wizard.records)
        assert not desk.context.worker.running("base")
    assert "Stop the procedure" not in desk.shown() and "stopped" in desk.said[1]
    assert (view.run.wizard.index, len(view.run.wizard.records)) == stood
    with desk.holding():
        desk.does(lambda: view._start(whole=True))
        until(lambda: view.run.relation is not None, "the relation")
    desk.rests()
    assert "Stop the procedure" not in desk.shown()


def test_the_slider_by_hand_stands_where_the_procedure_was_stopped(opened):
    """It stood where the axis was when its step began: at the first touch the arm turned back by all of that."""
    desk, view = opened, opened.view("run")
    with desk.holding():
        desk.does(lambda: view._start(whole=True))
        until(
            lambda: (s := view.run.wizard.step).axis == 1 and view.run.wizard.of(s.key), "a point of axis 1"
        )
        desk.press("Stop the procedure")
    at = deg(view.run.postures[0][0])
    assert abs(at) > 1.0 and view._hand._angle.value == pytest.approx(at, abs=0.51)  # whole degrees


def test_once_both_tools_have_met_what_was_found_is_taken_away_next(opened):
    desk, view = opened, opened.view("run")
    desk.does(lambda: setattr(view._every, "value", 30.0))
    desk.moves(lambda: view._start(whole=True))
    assert standing_out(desk.context.ui, "base") == ["Send both tools to one point"]
    desk.moves(view._meet)
    assert view.run.meeting is not None
    assert standing_out(desk.context.ui, "base") == ["Export the relation"]


def test_the_emergency_stop_ends_it_and_takes_its_button_away(opened):
    desk, view = opened, opened.view("run")
    with desk.holding():
        desk.does(lambda: view._start(whole=True))
        desk.live.stop()
    desk.idle()
    assert not desk.context.worker.running("base") and "Stop the procedure" not in desk.shown()


def test_the_relation_is_exported_and_printed_in_both_languages_without_the_truth(opened):
    desk, view = opened, opened.view("run")
    assert "Export the relation" not in desk.shown()
    with desk.holding():
        desk.does(lambda: view._start(whole=True))
        until(lambda: view.run.relation is not None, "the relation")
    desk.rests()
    found = view.run.relation.T_base1_base2
    desk.press("Download", "Export the relation")
    told = json.loads(sent(desk)["two_robots.json"])
    assert np.allclose(np.array(told["T_base1_base2"])[:3, 3], mm(found.position), atol=1e-6)
    assert told["format"] == "teachframe.base/1"
    truth = make_cell("irb120", "ur10e", SEED).T_base1_base2.position
    for language, word in (("en", "95%"), ("zh", "95%")):
        desk.live.choose("language", language)
        desk.idle()
        label = {"en": ("Download", "Report to print"), "zh": ("下载", "打印报告")}[language]
        desk.press(*label)
        page = sent(desk)["two_robots.html"].decode()
        assert f'lang="{language}"' in page and word in page
        numbers = {float(n) for n in re.findall(r"-?\d+\.\d+", page)}
        assert all(min(abs(n - v) for n in numbers) < 2e-3 for v in mm(found.position))
        assert not all(min(abs(n - v) for n in numbers) < 5e-4 for v in mm(truth))
