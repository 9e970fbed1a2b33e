"""Who gets which session: back after a reload, one page a session, forgotten after a while, kept from others."""

import time

import numpy as np
import pytest
from sqlalchemy import event

from app.session import Store
from app.session.actions import ChooseRobot, Finish, Record, SetUserFrame
from app.session.motion.user_frame import user_frame
from app.session.owners import Owners, owner_of
from app.training.cell import begin
from app.training.exercise import exercise
from app.training.records import Records
from app.workers.hub import Hub
from tests.desk import SECRET, Desk, until


@pytest.fixture
def hub(tmp_path):
    hub = Hub(Store(tmp_path), robot="ur10e", linger=0.05)
    yield hub
    hub.close()


def enter(hub, secret=SECRET):
    desk = Desk(hub.enter(owner_of(secret)))
    desk.idle()
    return desk


def leave(hub, desk):
    """A page comes and goes; waits until the session is forgotten."""
    page = object()
    hub.arrive(desk.live, page)
    hub.depart(desk.live, page)
    until(lambda: desk.live.closed, "the session's end")


def test_each_person_has_a_session_of_his_own(hub):
    one, two = enter(hub, "one"), enter(hub, "two")
    one.does(lambda: one.context.do(Record("touch1")))
    assert "touch1" in one.state.captures and not two.state.captures


def test_a_reload_finds_the_very_same_session_and_scene(hub):
    desk, first = enter(hub), object()
    hub.arrive(desk.live, first)
    hub.depart(desk.live, first)
    again = hub.enter(owner_of(SECRET))
    assert again is desk.live and not again.closed
    second = object()
    hub.arrive(again, second)
    time.sleep(0.15)
    assert not again.closed, "somebody is there again"


def test_whoever_comes_later_finds_the_session_as_it_was_left(hub):
    desk = enter(hub)
    desk.does(lambda: desk.context.do(Record("touch1")))
    desk.does(lambda: desk.context.do(SetUserFrame((0.4, 0.1, 0.2), (0.0, 0.0, 0.0, 2.0))))
    desk.does(lambda: desk.drive.show(desk.q + 0.05))
    name, q = desk.context.session.name, desk.q.copy()
    leave(hub, desk)
    back = enter(hub)
    assert back.live is not desk.live and back.context.session.name == name
    assert "touch1" in back.state.captures and np.allclose(back.q, q)
    assert "points recorded: 1" in back.said[1]
    assert np.allclose(user_frame(back.state, back.context.world).position, [0.4, 0.1, 0.2])


def test_a_second_page_takes_over_and_the_first_one_going_changes_nothing(hub):
    desk, first, second = enter(hub), object(), object()
    hub.arrive(desk.live, first)
    hub.arrive(desk.live, second)
    assert not hub.shows(desk.live, first) and hub.shows(desk.live, second)
    hub.depart(desk.live, first)
    time.sleep(0.15)
    assert not desk.live.closed and hub.shows(desk.live, second)


def test_a_secret_nobody_gave_out_begins_a_new_session(hub):
    name = enter(hub).context.session.name
    for made_up in ("../../../etc/passwd", name, owner_of(SECRET)):
        assert enter(hub, made_up).context.session.name != name


def test_what_is_exported_or_stored_makes_nobody_its_owner(hub):
    desk = enter(hub)
    exported = hub.store.export(desk.context.session.name)
    assert SECRET.encode() not in exported and owner_of(SECRET).encode() not in exported
    with hub.store.database.begin() as connection:
        rows = str(connection.exec_driver_sql("select * from owned").all())
    assert SECRET not in rows and owner_of(SECRET) in rows
    assert enter(hub, owner_of(SECRET)).context.session.name != desk.context.session.name


def test_a_person_sees_his_own_sessions_and_those_that_are_nobodys(hub):
    one, two = enter(hub, "one"), enter(hub, "two")
    stray = hub.store.create(robot="ur10e")
    stray.close()
    mine = {listed.name for listed, _ in one.context.shelf.mine(50)}
    assert mine == {one.context.session.name, stray.name}
    assert not one.context.shelf.may(two.context.session.name) and one.context.shelf.may(stray.name)


def test_sessions_are_named_and_deleted_by_their_owner(hub):
    desk = enter(hub)
    desk.press("Name", "first try", "text")
    owners = Owners(hub.store.database)
    assert owners.titles(owner_of(SECRET)) == {desk.context.session.name: "first try"}
    stray = hub.store.create(robot="ur10e")
    stray.close()
    sessions = desk.view("_rename")
    desk.does(sessions._fill)
    sessions._list.value = next(t for t, (s, _) in sessions._sessions.items() if s.name == stray.name)
    desk.does(sessions._about)
    desk.does(sessions._delete)
    assert hub.store.has(stray.name), "asked once"
    desk.does(sessions._delete)
    assert not hub.store.has(stray.name)


def test_a_session_that_is_open_is_not_deleted(hub):
    desk = enter(hub)
    sessions = desk.view("_rename")
    for _ in range(2):
        desk.does(sessions._delete)
    assert hub.store.has(desk.context.session.name) and desk.said[0] == "warning"


def test_the_page_goes_on_with_another_session_when_one_is_opened(hub):
    desk = enter(hub)
    desk.does(desk.view("_rename")._new)
    until(lambda: desk.live.closed, "the session before to be closed")
    after = enter(hub)
    assert after.context.session.name != desk.context.session.name
    assert after.context.session.name in Owners(hub.store.database).titles(owner_of(SECRET))


def test_a_damaged_journal_begins_a_new_session_and_keeps_the_rows(hub):
    desk = enter(hub)
    leave(hub, desk)
    with hub.store.database.begin() as connection:
        connection.exec_driver_sql("update actions set action = 'rubbish'")
    fresh = enter(hub)
    assert fresh.context.session.name != desk.context.session.name
    assert hub.store.has(desk.context.session.name)
    assert fresh.said[0] == "warning"


def test_a_fault_in_a_job_is_told_and_changes_nothing(hub):
    desk = enter(hub)
    before = desk.state
    desk.does(lambda: 1 / 0)
    assert desk.said[0] == "error" and "ZeroDivisionError" in desk.said[1]
    assert desk.state is before


def test_a_refusal_is_told_in_the_operators_language(hub):
    desk = enter(hub)
    desk.live.choose("language", "zh")
    desk.does(lambda: desk.context.do(Record("touch1")))
    desk.does(lambda: desk.context.do(Record("touch1")))
    assert desk.said[0] == "warning" and "已记录" in desk.said[1]


def test_another_arm_is_shown_with_its_own_joints(hub):
    desk = enter(hub)
    desk.does(lambda: desk.context.do(ChooseRobot("iiwa7")))
    assert len(desk.q) == 7 and desk.context.stage.arm.robot.name == "iiwa7"
    assert [axis.name for axis in desk.live.read().axes] == [f"J{k}" for k in range(1, 8)]
    assert not [entry for entry in desk.context.log if entry[1] == "error"]


def test_a_score_the_server_did_not_live_to_keep_is_kept_when_the_session_comes_back_and_once(hub):
    desk = enter(hub)
    name = desk.context.session.name
    leave(hub, desk)
    chosen = exercise("tool_with_axes")
    session = hub.store.open(name)
    for action in (begin(chosen, 7, 1000.0, "Ada"), Finish(given_up=True)):
        session.do(action)
    session.close()
    records = Records(hub.store.database)
    assert not records.history("Ada")
    for _ in range(2):
        again = enter(hub)
        assert [card.exercise for card in records.history("Ada")] == [chosen.key]
        leave(hub, again)


def test_a_session_whose_page_never_comes_is_closed_after_a_while(tmp_path):
    hub = Hub(Store(tmp_path), robot="ur10e", unvisited=1.0)
    try:
        silent, seen, page = hub.enter(owner_of("silent")), hub.enter(owner_of("seen")), object()
        hub.arrive(seen, page)
        until(lambda: silent.closed, "the session nobody came to")
        assert not seen.closed and hub.lives == [seen]
    finally:
        hub.close()


def test_coming_and_going_leaves_nothing_behind(hub):
    import threading

    for _ in range(3):
        leave(hub, enter(hub))
    before = threading.active_count()
    for _ in range(6):
        leave(hub, enter(hub))
    assert not hub.lives
    until(lambda: threading.active_count() <= before, "the threads to end", 10.0)


def test_to_open_a_session_asks_as_little_of_the_database_in_a_class_as_alone(tmp_path):
    store = Store(tmp_path)
    hub = Hub(store, robot="ur10e")
    asked = []
    event.listen(store.database._engine, "before_cursor_execute", lambda *about: asked.append(about[2]))

    def statements(secret):
        enter(hub, secret)
        before = len(asked)
        hub.leave(owner_of(secret))
        enter(hub, secret)
        beats = sum("leases" in words for words in asked[before:])  # by the clock
        return len(asked) - before - beats

    alone = statements("first")
    for number in range(30):
        store.create(robot="ur10e").close()
        hub.owners.give(store.names()[0], owner_of(f"other {number}"))
    assert statements("last") == alone
    hub.close()


def test_the_list_shows_ones_own_and_what_is_nobodys(tmp_path):
    store = Store(tmp_path)
    hub = Hub(store, robot="ur10e")
    mine, other = enter(hub, "me"), enter(hub, "another")
    old = store.create(robot="ur10e").name
    names = [listed.name for listed, _ in mine.live.context.shelf.mine(60)]
    assert names == [old, mine.live.session.name] and other.live.session.name not in names
    assert [listed.name for listed, _ in mine.live.context.shelf.mine(1)] == [old]
    hub.close()
