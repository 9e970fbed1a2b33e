"""A trainer's copy of a trainee's session: opened, played again, the same result; nothing of it is the trainee's."""

import numpy as np
import pytest

from app.cli import run
from app.resources import STATIC
from app.screens._tool.paper import calculate
from app.session.actions import Record
from app.session.points import load_action
from app.training.exercise import exercise
from tests.desk import Desk, brisk, plain, until  # noqa: F401

TABLE_1 = STATIC / "samples" / "xiong2012_table1.csv"


@pytest.fixture
def opened(hub, trainer, at, ada, seated):
    """Copies what the trainee has open, as the trainer's page does, and sits down at the copy."""

    def open_():
        trainer.post(f"/class/{at.id}/copy/{ada.person.id}")
        trainer.get("/")
        desk = Desk(hub.find(trainer.person.owner))
        hub.arrive(desk.live, desk)
        desk.drive.override = 1.0
        desk.idle()
        return desk

    return open_


def test_a_session_is_copied_into_the_trainers_own_and_its_owner_keeps_it(hub, trainer, ada, seated, opened):
    seated.does(lambda: seated.context.do(Record("touch1")))
    theirs = hub.store.recorded(seated.context.session.name).entries
    desk = opened()
    copy = desk.context.session.name
    assert copy == hub.owners.latest(trainer.person.owner) != seated.context.session.name
    assert hub.store.recorded(copy).entries == theirs
    assert hub.owners.latest(ada.person.owner) == seated.context.session.name
    assert "Ada" in hub.owners.titles(trainer.person.owner)[copy]


def test_a_copy_is_played_again_and_gives_the_same_result(hub, seated, opened, brisk, tmp_path, capsys):  # noqa: F811
    """The arm goes where the trainee's went; the end is his result, in the page and on the command line."""
    q = seated.q + np.array([0.2, 0.1, -0.1, 0.0, 0.1, 0.0])
    seated.place(q)
    seated.does(lambda: seated.context.do(Record("touch1")))
    seated.place(q - 0.1)
    seated.does(lambda: (seated.context.do(load_action(TABLE_1)), calculate(seated.context)))
    his, his_count = seated.state.result.result, seated.state.count
    desk = opened()
    mine = desk.state.result.result
    np.testing.assert_array_equal(mine.T_flange_tool.matrix, his.T_flange_tool.matrix)
    before, stood = desk.state.count, desk.q
    went, pose = [], desk.context.stage.pose
    desk.context.stage.pose = lambda q, *rest: (went.append(np.array(q)), pose(q, *rest))
    sessions = desk.view("_rename")
    with desk.holding():
        desk.does(lambda: (sessions._fill(), sessions._play()))
        desk.rests()
    said = plain(sessions._told.content)
    assert f"{before} of {before}" in said, said
    assert min(np.abs(at - q).max() for at in went) < 1e-9, "the arm was where the point was recorded"
    np.testing.assert_array_equal(desk.q, stood)
    assert desk.state.count == before and seated.state.count == his_count

    copy = tmp_path / "copy.jsonl"
    copy.write_bytes(hub.store.export(desk.context.session.name))
    own = tmp_path / "own.jsonl"
    own.write_bytes(hub.store.export(seated.context.session.name))
    told = []
    for path in (copy, own):
        assert run(["replay", str(path)]) == 0
        told.append([line for line in capsys.readouterr().out.splitlines() if "session" not in line.lower()])
    assert told[0] == told[1] and told[0]


def test_a_copy_of_a_running_exercise_is_no_score_of_anybody(hub, trainer, ada, seated, opened):
    seated.does(lambda: seated.view("choose").start(exercise("first_tool")))
    desk = opened()
    desk.finish()
    assert not hub.records.history(ada.person.id) and not hub.records.history(trainer.person.id)
    assert seated.state.running is not None, "the trainee's own attempt still runs"
