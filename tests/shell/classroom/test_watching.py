"""A trainee's arm, watched: live, read only, and he knows."""

import json
import threading
import time
from contextlib import suppress

import msgspec
import numpy as np
import pytest
from anyio import ClosedResourceError
from starlette.websockets import WebSocketDisconnect

from app.errors import StorageError
from app.shell.classroom import watching
from tests.desk import until

PROTOCOL = "viser-v1.1.1"
#: Oldest a joint value may be when a watcher gets it [s].
DELAY_S = 0.5
FIGURES = 60


@pytest.fixture
def path(at, ada):
    return f"/class/{at.id}/watch/{ada.person.id}"


def packed(kind, **fields):
    return msgspec.msgpack.encode({"type": kind, **fields})


def test_joint_values_are_less_than_half_a_second_old(trainer, seated, path):
    """The arm stands elsewhere every 50 ms; each figure that arrives is looked up: when did the arm stand there?"""
    stood, enough = {}, threading.Event()
    base = seated.q.copy()

    def move():
        k = 0
        while not enough.wait(0.05):
            k += 1
            q = base.copy()
            q[0] += 0.01 * (k % 100)
            stood[f"{np.degrees(q[0]):.2f}"] = time.monotonic()
            seated.context.post(lambda q=q: seated.drive.show(q))

    ages = []
    with trainer.socket(f"{path}/words") as page:
        page.receive_text()
        thread = threading.Thread(target=move)
        thread.start()
        while len(ages) < FIGURES:
            value = f"{json.loads(page.receive_text())['axes'][0]['number']:.2f}"
            if value in stood:
                ages.append(time.monotonic() - stood[value])
        enough.set()
        thread.join()
    assert max(ages) < DELAY_S, max(ages)
    print(
        f"joint values' age: median {np.median(ages) * 1e3:.0f} ms, most {max(ages) * 1e3:.0f} ms, {len(ages)} figures"
    )


def test_the_scene_comes_and_nothing_the_watcher_says_gets_there(trainer, seated, path):
    live, server = seated.live, seated.live._server
    heard = []
    server._websock_server._handle_incoming_message = lambda *said: heard.append(said) or _nothing()
    before = seated.q.copy()
    with trainer.socket(f"{path}/scene", subprotocols=[PROTOCOL]) as page:
        assert page.accepted_subprotocol == PROTOCOL
        assert len(page.receive_bytes()) > 100
        camera = {
            "wxyz": (1.0, 0.0, 0.0, 0.0),
            "position": (0.0, 0.0, 1.0),
            "fov": 1.0,
            "near": 0.1,
            "far": 10.0,
        }
        camera |= {
            "image_height": 100,
            "image_width": 100,
            "look_at": (0.0, 0.0, 0.0),
            "up_direction": (0.0, 0.0, 1.0),
        }
        page.send_bytes(packed("ViewerCameraMessage", **camera))
        page.send_bytes(packed("TransformControlsDragStartMessage", name="/handle"))
        page.send_bytes(
            packed("TransformControlsUpdateMessage", name="/handle", wxyz=(1, 0, 0, 0), position=(0, 0, 1))
        )
        page.send_bytes(b"\x00" * 1000)
        seated.place(seated.q + 0.01)  # something comes after them: the way is still open
        assert page.receive_bytes()
    seated.idle()
    assert not server.get_clients() and not heard and not live.context.stage.handle.dragging
    assert np.allclose(seated.q, before + 0.01)


async def _nothing():
    return None


def test_the_trainee_is_told_while_it_lasts(trainer, seated, path):
    assert not seated.live.read().watched
    with trainer.socket(f"{path}/words") as page:
        page.receive_text()
        assert seated.live.read().watched
    until(lambda: not seated.live.read().watched, "the watcher to be gone")


def test_what_a_watcher_says_is_not_heeded(trainer, seated, path):
    with trainer.socket(f"{path}/words") as page:
        page.receive_text()
        for said in (
            {"t": "stop"},
            {"t": "beat", "en": True, "axis": 0, "sign": 1, "press": 1},
            {"t": "home"},
        ):
            page.send_text(json.dumps(said))
        time.sleep(0.3)
    assert seated.drive.how == "standing" and not seated.drive.live


def test_who_leaves_the_class_is_watched_no_more(trainer, people, at, ada, seated, path, monkeypatch):
    monkeypatch.setattr(watching, "_ASKED", 0.2)
    with trainer.socket(f"{path}/words") as page:
        page.receive_text()
        people.classes.dismiss(at.id, ada.person.id)
        with pytest.raises(WebSocketDisconnect) as closed:
            for _ in range(20):
                page.receive_text()
    assert closed.value.code == 4401


def test_who_is_not_there_is_said_and_waited_for(trainer, ada, path):
    with pytest.raises(WebSocketDisconnect) as closed, trainer.socket(f"{path}/words") as page:
        page.receive_text()
    assert closed.value.code == 4404


def test_the_watchers_scene_is_the_page_of_the_scene(trainer, seated, path):
    answer = trainer.get(f"{path}/scene/")
    assert "frame-ancestors 'self'" in answer.headers["content-security-policy"]
    trainer.get(f"{path}/scene/?websocket=ws://evil.example", 400)


def test_watching_is_in_the_audit_log(trainer, people, ada, path):
    trainer.get(path)
    assert ("watch", ada.person.id) in {
        (e.deed, e.about) for e in people.audit.read(person=trainer.person.id)
    }


def test_a_database_that_is_away_for_a_moment_ends_nobodys_watching(trainer, hub, seated, path, monkeypatch):
    monkeypatch.setattr(watching, "_ASKED", 0.0)
    asked = []

    def away(*_):
        asked.append(1)
        raise StorageError("away")

    figures = []

    def listen(page):
        with suppress(WebSocketDisconnect, ClosedResourceError):
            while True:
                figures.append(json.loads(page.receive_text())["axes"][0]["number"])

    with trainer.socket(f"{path}/words") as page:
        page.receive_text()
        monkeypatch.setattr(hub.room, "members", away)
        threading.Thread(target=listen, args=(page,), daemon=True).start()
        seated.place(seated.q + 0.01)
        until(lambda: asked, "it to be asked")
        seated.place(seated.q + 0.01)
        now = seated.live.read().axes[0].number
        until(lambda: now in figures, "the figures of now", 20.0)
