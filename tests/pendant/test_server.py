"""The server with browsers that have no screen: who gets which session."""

import time

import numpy as np
import pytest

from app.pendant.server import PendantServer
from app.pendant.user_frame import user_frame
from app.session import Store
from app.session.actions import Finish, Record, SetUserFrame
from app.training.cell import begin
from app.training.exercise import exercise
from app.training.records import Records
from benchmarks._browser import Browser

PATIENCE_S = 20.0

pytestmark = pytest.mark.xdist_group("pendant_server")


def until(true, what):
    end = time.monotonic() + PATIENCE_S
    while not true():
        assert time.monotonic() < end, f"waited {PATIENCE_S:g} s for {what}"
        time.sleep(0.01)


@pytest.fixture
def server(tmp_path):
    server = PendantServer(Store(tmp_path), port=0, robot="ur10e")
    yield server
    server.stop()


@pytest.fixture
def enter(server):
    """Opens a browser and waits until its page is made: (browser, pendant)."""
    browsers = []

    def open_(token=None):
        before = {id(p) for p in server.pendants}
        browser = Browser(server.port, token)
        browsers.append(browser)
        until(lambda: any(id(p) not in before for p in server.pendants), "the pendant")
        pendant = next(p for p in server.pendants if id(p) not in before)
        until(lambda: hasattr(pendant, "page") and pendant.worker.idle(0.05), "the page")
        return browser, pendant

    yield open_
    for browser in browsers:
        browser.close()


def test_each_browser_has_its_own_session(enter):
    (_, one), (_, two) = enter(), enter()
    one.post(lambda: one.do(Record("touch1")))
    assert one.worker.idle()
    assert "touch1" in one.session.state.captures and not two.session.state.captures


def test_a_reload_hands_the_session_back(enter, server):
    browser, pendant = enter()
    pendant.post(lambda: pendant.do(Record("touch1")))
    assert pendant.worker.idle()
    until(lambda: browser.token, "the token")
    name = pendant.session.name
    assert browser.token == name
    browser.close()
    until(lambda: not server.pendants and not server.hub.names, "the server to notice")
    _, back = enter(name)
    assert back.session.name == name and "touch1" in back.session.state.captures


def test_the_user_frame_comes_back_with_the_session(enter, server):
    browser, pendant = enter()
    pendant.post(lambda: pendant.do(SetUserFrame((0.4, 0.1, 0.2), (0.0, 0.0, 0.0, 2.0))))
    assert pendant.worker.idle()
    frame = user_frame(pendant)
    until(lambda: browser.token, "the token")
    browser.close()
    until(lambda: not server.pendants and not server.hub.names, "the server to notice")
    _, back = enter(browser.token)
    assert np.allclose(frame.position, [0.4, 0.1, 0.2]) and np.allclose(np.diag(frame.rotation), [-1, -1, 1])
    assert np.array_equal(user_frame(back).matrix, frame.matrix)


def test_a_second_tab_takes_over_and_the_first_lets_go(enter, server):
    browser, first = enter()
    until(lambda: browser.token, "the token")
    _, second = enter(browser.token)
    assert second.session is first.session
    until(lambda: not first.open, "the first tab to let go")
    second.post(lambda: second.do(Record("touch1")))
    assert second.worker.idle()
    assert "touch1" in second.session.state.captures
    browser.close()
    second.post(lambda: second.do(Record("touch2")))
    assert second.worker.idle()
    assert "touch2" in server.hub.store.state(second.session.name).captures


def test_a_token_nobody_gave_out_begins_a_new_session(enter):
    browser, pendant = enter("../../../etc/passwd")
    assert pendant.session.name != "../../../etc/passwd"
    until(lambda: browser.token == pendant.session.name, "the new token")


def test_a_damaged_journal_begins_a_new_session_and_keeps_the_rows(enter, server):
    browser, pendant = enter()
    until(lambda: browser.token, "the token")
    browser.close()
    until(lambda: not server.pendants and not server.hub.names, "the server to notice")
    with server.hub.store.database.begin() as connection:
        connection.exec_driver_sql("update actions set action = 'rubbish'")
    _, fresh = enter(browser.token)
    assert fresh.session.name != pendant.session.name
    assert server.hub.store.has(pendant.session.name)
    assert fresh.log[-1][1] == "warning"


def test_a_fault_in_a_job_is_told_and_changes_nothing(enter):
    _, pendant = enter()
    before = pendant.session.state
    pendant.post(lambda: 1 / 0)
    assert pendant.worker.idle()
    assert pendant.log[-1][1] == "error" and "ZeroDivisionError" in pendant.log[-1][2]
    assert pendant.session.state is before


def test_a_refusal_is_told_in_the_operators_language(enter):
    _, pendant = enter()
    pendant.language = "zh"
    pendant.post(lambda: pendant.do(Record("touch1")))
    pendant.post(lambda: pendant.do(Record("touch1")))
    assert pendant.worker.idle()
    assert pendant.log[-1][1] == "warning" and "已记录" in pendant.log[-1][2]


def test_a_drag_out_of_reach_says_so_and_the_arm_stays_within_its_limits(enter):
    from app.geometry import Pose

    _, pendant = enter()
    start = pendant.world.tip(pendant.q)
    far = Pose.of(start.rotation, start.position + np.array([9.0, 0.0, 0.0]))
    pendant.dragging.event("update", far)
    pendant.dragging.event("end", far)
    assert pendant.worker.idle()
    assert pendant.log[-1][1] == "warning" and pendant.log[-1][2].startswith("Stopped:")
    assert pendant.model.within_limits(pendant.q)
    assert np.array_equal(pendant.session.state.q, pendant.q)


def test_a_second_tab_finds_the_arm_where_the_first_had_moved_it_and_keeps_it(enter, server):
    browser, first = enter()
    until(lambda: browser.token, "the token")
    aim = first.q + 0.05
    first.post(lambda: first.place(aim))  # not yet written down when the other comes
    until(lambda: np.allclose(first.q, aim), "the arm to move")
    _, second = enter(browser.token)
    assert np.array_equal(second.q, first.q) and first._given.is_set()
    second.post(lambda: second.place(second.q + 0.05))
    assert second.worker.idle()
    first.post(lambda: first.place(aim))  # what the first tab still sends is for nobody
    browser.close()
    until(lambda: first not in server.pendants, "the server to notice")
    until(lambda: first not in server._leaving, "the first tab's end")
    assert np.allclose(second.session.state.q, aim + 0.05)
    assert np.array_equal(server.hub.store.state(second.session.name).q, second.q)


def test_where_the_arm_was_left_is_written_when_the_browser_goes(enter, server):
    browser, pendant = enter()
    aim = pendant.q + 0.05
    pendant.post(lambda: pendant.place(aim))
    until(lambda: np.allclose(pendant.q, aim), "the arm to move")
    browser.close()
    until(lambda: not server.pendants and not server.hub.names, "the server to notice")
    assert np.allclose(server.hub.store.state(pendant.session.name).q, aim)


def test_a_score_the_server_did_not_live_to_keep_is_kept_when_the_session_comes_back_and_once(enter, server):
    browser, _ = enter()
    until(lambda: browser.token, "the token")
    browser.close()
    until(lambda: not server.pendants and not server.hub.names, "the server to notice")
    chosen = exercise("tool_with_axes")
    session = server.hub.store.open(browser.token)
    for action in (begin(chosen, 7, 1000.0, "Ada"), Finish(given_up=True)):
        session.do(action)
    records = Records(server.hub.store.database)
    assert not records.history("Ada")
    for _ in range(2):
        again, _ = enter(browser.token)
        assert [card.exercise for card in records.history("Ada")] == [chosen.key]
        again.close()
        until(lambda: not server.pendants and not server.hub.names, "the server to notice")


def test_another_arm_is_shown_with_its_own_joints(enter):
    from app.session.actions import ChooseRobot

    _, pendant = enter()
    pendant.post(lambda: pendant.do(ChooseRobot("iiwa7")))
    assert pendant.worker.idle()
    assert len(pendant.q) == 7 and pendant.stage.arm.robot.name == "iiwa7"
    assert not [entry for entry in pendant.log if entry[1] == "error"]


def test_coming_and_going_leaves_nothing_behind(enter, server):
    for _ in range(5):
        browser, _ = enter()
        browser.close()
        until(lambda: not server.pendants and not server.hub.names, "the server to notice")
