"""The page's socket without a browser: hold, dead-man, watchdog, stop, widgets, taking over."""

import json
import time

import msgspec
import numpy as np
import pytest
from starlette.websockets import WebSocketDisconnect

from app.shell.messages import VERSION, In, heard
from tests.desk import until
from tests.shell.conftest import ORIGIN, SOCKET, Page


def test_a_page_is_greeted_with_its_texts_its_widgets_and_the_figures(page):
    hello, panel = page.hear("hello"), page.hear("panel")
    assert hello["version"] == VERSION and hello["texts"]["page.stop"] == "STOP"
    assert panel["whole"]
    kinds = {w["kind"] for w in panel["widgets"]}
    while not {"screen", "rows", "button"} <= kinds:  # the screens may still be in the making
        kinds |= {w["kind"] for w in page.hear("panel")["widgets"]}
    read = page.hear("read")
    assert read["how"] == "standing" and len(read["axes"]) == 6 and read["robot"] == "Universal Robots UR10e"


def test_holding_moves_and_letting_go_stops(page):
    before = page.q
    page.hold(0.4, en=True, axis=2, sign=1, press=1)
    page.say(t="beat", en=True)
    until(lambda: not page.live.context.worker.running("jog"), "the stand-still")
    moved = page.q - before
    assert moved[2] > 0.01 and not np.delete(moved, 2).any()


def test_a_button_without_the_switch_moves_nothing(page):
    before = page.q
    page.hold(0.3, en=False, axis=0, sign=1, press=1)
    assert np.array_equal(page.q, before)
    until(lambda: "enabling switch" in page.live.read().message, "the reason")


def test_silence_stops_and_a_woken_page_has_to_let_go_first(page):
    page.hold(0.3, en=True, axis=0, sign=1, press=1)
    time.sleep(0.3)
    stands = page.q
    page.hold(0.3, en=True, axis=0, sign=1, press=1)
    assert np.array_equal(page.q, stands) and page.state()["read"]["tripped"]
    page.say(t="beat", en=False)
    page.hold(0.3, en=True, axis=0, sign=1, press=2)
    assert page.q[0] > stands[0]


def test_the_arm_stands_when_the_page_goes(client, hub):
    with Page(client, hub) as page:
        page.hold(0.2, en=True, axis=0, sign=1, press=1)
        live = page.live
    until(lambda: not live.context.worker.running("jog"), "the stand-still")
    assert not live.context.drive.live


def test_the_first_press_after_a_reload_moves_though_it_has_the_number_of_one_before(client, hub):
    """Pages number their presses from the beginning: the same button was dead for one press after a reload."""
    with Page(client, hub) as page:
        page.hold(0.2, en=True, axis=0, sign=1, press=1)
        live = page.live
    until(lambda: not live.context.worker.running("jog"), "the stand-still")
    stood = live.context.q.copy()
    with Page(client, hub) as again:
        assert again.live is live
        again.hold(0.3, en=True, axis=0, sign=1, press=1)
        assert again.q[0] > stood[0] + 0.01


def test_the_stop_latches_until_it_is_released_and_pressed_anew(page):
    page.hold(0.2, en=True, axis=0, sign=1, press=1)
    page.say(t="stop")
    until(lambda: page.live.read().how == "stopped", "the stop")
    stands = page.q
    page.hold(0.2, en=True, axis=0, sign=1, press=2)
    assert np.array_equal(page.q, stands) and page.state()["read"]["how"] == "stopped"
    page.say(t="release")
    until(lambda: page.live.read().how == "standing", "the release")
    page.hold(0.2, en=True, axis=0, sign=1, press=2)
    assert np.array_equal(page.q, stands), "held all the while"
    page.say(t="beat", en=False)
    page.hold(0.3, en=True, axis=0, sign=1, press=3)
    assert page.q[0] > stands[0]


def test_home_and_typed_values_wait_for_the_switch(page):
    page.hold(
        0.3, en=True, axis=0, sign=1, press=1
    )  # away from home: from there, there is nothing to wait for
    page.say(t="beat", en=False)
    until(lambda: page.live.read().how == "standing", "the stand-still")
    page.say(t="joint", axis=0, value=10.0)
    until(lambda: page.live.read().how == "waiting", "the motion that waits")
    assert "axis 1" in page.state()["read"]["errand"]
    page.say(t="cancel")
    until(lambda: page.live.read().how == "standing", "it to be given up")
    page.say(t="home")
    until(lambda: page.live.read().how == "waiting", "the way home")


def test_the_state_of_every_screen_is_there_as_json(page):
    state = page.state()
    labels = {w.get("label") for w in state["widgets"]}
    screens = {w["key"] for w in state["widgets"] if w["kind"] == "screen"}
    assert screens == {"tool", "compare", "base", "load", "training", "sessions", "cell", "log"}
    assert "Record Touch 1" in labels and state["read"]["pose"][0][0] == "X"


def test_a_press_is_heard_and_what_changed_comes_back(page):
    page.hear("panel")
    button = next(w for w in page.state()["widgets"] if w.get("label") == "Record Touch 1")
    page.say(t="press", id=button["id"])
    until(lambda: "touch1" in page.live.context.session.state.captures, "the record")
    changed = page.hear("panel")
    assert not changed["whole"]
    assert page.hear("read")["points"].endswith("1/6") or page.state()["read"]["points"].endswith("1/6")


@pytest.mark.parametrize(
    "text",
    [
        "", "[]", "{}", '{"t":"beat"}', '{"t":"beat","en":1}', '{"t":"beat","en":true,"axis":"x"}', '{"t":"fly"}',
        '{"t":"choose","what":"override","value":1e999}', '{"t":"joint","axis":0,"value":"x"}', "{" * 5000,
        '{"t":"press","id":1e30}', '{"t":"beat","en":true,"more":1}', '{"t":"choose","what":"override","value":[1]}',
    ],
)  # fmt: skip
def test_what_no_page_of_ours_says_changes_nothing_and_ends_nothing(page, text):
    before = page.state()["read"]
    page.socket.send_text(text)
    page.say(t="beat", en=True, axis=99, sign=1, press=1)
    page.say(t="beat", en=True, axis=-1, sign=1, press=2)
    page.say(t="beat", en=False)
    page.say(t="joint", axis=99, value=1.0)
    page.say(t="choose", what="frame", value="nowhere")
    page.say(t="press", id=10**9, value="x")
    page.say(t="ping", n=1.0)
    assert page.hear("pong")["n"] == 1.0
    after = page.state()["read"]
    assert [a["value"] for a in after["axes"]] == [a["value"] for a in before["axes"]]
    assert after["override"] == before["override"] and not page.live.closed


def test_every_message_is_typed():
    assert isinstance(heard('{"t":"beat","en":true,"axis":1,"sign":-1,"press":4}'), In)
    with pytest.raises(msgspec.DecodeError):
        heard('{"t":"beat","en":true,"axis":1.5}')


def test_a_second_page_takes_the_session_over_and_the_first_can_do_nothing(page, client, hub):
    with client.websocket_connect(f"{SOCKET}/words", headers=ORIGIN) as second:
        assert page.hear("taken")
        with pytest.raises(WebSocketDisconnect) as closed:
            page.hear("read")
        assert closed.value.code == 4001
        second.send_text(json.dumps({"t": "ping", "n": 2.0}))
        while json.loads(second.receive_text())["t"] != "pong":
            pass
        assert len(hub.lives) == 1


def test_language_and_looks_are_said_anew(page):
    page.hear("hello")
    page.say(t="choose", what="language", value="zh")
    hello = page.hear("hello")
    assert hello["texts"]["page.stop"] == "急停" and '"zh"' in hello["choices"]["look"]
    page.say(t="choose", what="dark", value=True)
    assert page.hear("hello")["choices"]["dark"] is True


def test_two_hundred_reloads_leave_one_session_and_no_growth(client, hub):
    import gc
    import threading

    for _ in range(20):
        with Page(client, hub):
            pass
    threads, listeners = threading.active_count(), len(hub.lives[0]._listeners)
    for _ in range(180):
        with client.websocket_connect(f"{SOCKET}/words", headers=ORIGIN) as socket:
            socket.receive_text()
    gc.collect()
    until(lambda: len(hub.lives[0]._listeners) <= listeners, "the listeners to go")
    until(lambda: threading.active_count() <= threads + 2, "the threads to end")
    assert len(hub.lives) == 1
