"""One person floods the server; what its loop does at a time stays short, and others are answered.

What counts is the processor time of each turn of the server's loop: on a machine on which other tests run, the clock
says how busy that is.
"""

import asyncio
import gc
import http.client
import threading
import time
from contextlib import suppress

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from app.session import Store
from app.shell.server import PendantServer
from tests.desk import until
from tests.shell.hand import Hand

pytestmark = pytest.mark.xdist_group("pendant_server")

LONGEST_TURN = 0.020  # s of the processor
FLOOD_S = 2.0
SILENT = 100


@pytest.fixture
def server(tmp_path):
    server = PendantServer(Store(tmp_path), port=0, robot="ur10e")
    yield server
    server.stop()


@pytest.fixture
def turns(monkeypatch):
    """(seconds of the processor, what was called) of every turn of a loop on the server's thread; what earlier tests
    left is not looked through for garbage in it."""
    gc.collect()
    gc.freeze()
    seen, run = [], asyncio.events.Handle._run

    def measured(handle):
        if threading.current_thread().name != "pendant-server":
            return run(handle)
        what, begun = repr(handle)[:300], time.thread_time()
        try:
            return run(handle)
        finally:
            seen.append((time.thread_time() - begun, what))

    monkeypatch.setattr(asyncio.events.Handle, "_run", measured)
    return seen


def answered(port, hand):
    """Seconds until a person's page is answered."""
    begun = time.monotonic()
    hand.fetch("/state")
    return time.monotonic() - begun


def put(port, cookie, widget, data, drop="abc"):
    asked = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    headers = {"Cookie": cookie, "Origin": f"http://127.0.0.1:{port}"}
    asked.request("PUT", f"/upload/{widget}/{drop}?name=x.csv&last=1", body=data, headers=headers)
    status = asked.getresponse().status
    asked.close()
    return status


def widget(hand, label):
    until(lambda: any(w.get("label") == label for w in hand.widgets.values()), label)
    return next(n for n, w in hand.widgets.items() if w.get("label") == label)


def longest(turns):
    return max(turns, default=(0.0, ""))


def flood(hand, seconds, messages):
    """Says all of them over and over, as fast as the socket takes them.

    Its words are read 300 a second: a sender who has filled the socket's buffers waits in the midst of one, answers no
    ping behind it, and is put out. That is as it should be, and ends the flood.
    """
    end = time.monotonic() + seconds
    with suppress(ConnectionClosed):
        while time.monotonic() < end:
            for message in messages:
                hand.say(**message)


def test_undo_and_redo_as_fast_as_a_socket_takes_them(server, turns):
    one, other = Hand(server.port), Hand(server.port)
    until(lambda: any("Redo" in w.get("options", ()) for w in one.widgets.values()), "undo and redo")
    number = next(n for n, w in one.widgets.items() if "Redo" in w.get("options", ()))
    presses = [{"t": "press", "id": number, "value": word} for word in ("Undo", "Redo")]
    turns.clear()
    flooding = threading.Thread(target=flood, args=(one, FLOOD_S, presses))
    flooding.start()
    waits = [answered(server.port, other) for _ in range(5)]
    flooding.join()
    assert longest(turns)[0] < LONGEST_TURN, longest(turns)
    assert max(waits) < 5.0
    one.close(), other.close()


def test_files_that_are_made_to_stop_a_reader_are_not_read_in_the_loop(server, turns):
    one, other = Hand(server.port), Hand(server.port)
    drop, tool = widget(one, "Drop a recording and its URDF"), widget(one, "Load a tool frame")
    turns.clear()
    for number, data in enumerate(
        (b"[" * 64_000, b"set_tcp(p[" * 6_400, b"<a>" * 100_000, b"x" * 20_000_000)
    ):
        for target in (drop, tool):
            status = put(server.port, one.cookie, target, data, drop=f"d{number}{target}")
            assert status in (204, 413, 429)
    assert answered(server.port, other) < 5.0
    assert longest(turns)[0] < LONGEST_TURN, longest(turns)
    one.close(), other.close()


def test_messages_of_a_megabyte_and_of_nonsense(server, turns):
    one, other = Hand(server.port), Hand(server.port)
    turns.clear()
    text = "[" * 900_000
    for message in (text, '{"t":"press","id":1,"value":"' + "a" * 900_000 + '"}', "\0", "{}", '{"t":"zzz"}'):
        try:
            one._words.send(message)
        except ConnectionClosed:
            break
    assert answered(server.port, other) < 5.0
    assert longest(turns)[0] < LONGEST_TURN, longest(turns)
    one.close(), other.close()


def test_a_hundred_clients_that_say_nothing_keep_no_page_from_a_person(server, turns):
    first = Hand(server.port)
    address, headers = f"ws://127.0.0.1:{server.port}/words", {"Cookie": first.cookie}
    turns.clear()
    silent = []
    for number in range(SILENT):
        try:
            silent.append(
                connect(
                    address,
                    origin=f"http://127.0.0.1:{server.port}",
                    additional_headers=headers if number % 2 else {},
                )
            )
        except Exception:  # refused, as it may be
            continue
    begun = time.monotonic()
    newcomer = Hand(server.port)
    assert time.monotonic() - begun < 10.0
    assert longest(turns)[0] < LONGEST_TURN, longest(turns)
    for socket in silent:
        socket.close()
    first.close(), newcomer.close()
