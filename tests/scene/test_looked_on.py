"""Who only looks on gets no drag handle, floor and background of his own, and all else as viser sends it."""

import asyncio
import contextlib

import msgspec
import numpy as np
import pytest
import zstandard

from app.scene.ground import floor_colours, lay_floor
from app.scene.looked_on import for_onlooker
from app.scene.server import SceneServer


@pytest.fixture
def server():
    server = SceneServer()
    yield server
    server.stop()


class Silent:
    """A page that says nothing, and what came to it."""

    def __init__(self):
        self.frames = []

    async def send(self, frame):
        self.frames.append(frame)

    async def recv(self):
        await asyncio.Event().wait()


def frames(server, seconds=0.3):
    """What viser sends to somebody who says nothing."""
    page = Silent()

    async def look():
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(server.show(page), seconds)

    asyncio.run(look())
    return page.frames


def opened(frame):
    """(messages, their plain numbers)."""
    size, packed = (int.from_bytes(frame[k : k + 8], "little") for k in (0, 8))
    words = zstandard.ZstdDecompressor().decompress(frame[16 : 16 + packed], max_output_size=size)
    said, at, numbers = msgspec.msgpack.decode(words), 16 + packed, []
    for length in said["binaryBufferLengths"]:
        at += -at % 8
        numbers.append(bytes(frame[at : at + length]))
        at += length
    assert at == len(frame) or not numbers
    return said["messages"], numbers


def test_the_handle_is_left_out_and_the_rest_stays(server):
    mesh = np.arange(36, dtype=np.float32).reshape(12, 3)
    server.scene.add_mesh_simple("/arm", mesh, np.arange(12, dtype=np.uint32).reshape(4, 3))
    server.scene.add_transform_controls("/handle", scale=0.3)
    plain = frames(server)
    changed = [for_onlooker(frame, dark=False) for frame in plain]
    kinds = [m["type"] for frame in plain for m in opened(frame)[0]]
    shown = [m for frame in changed for m in opened(frame)[0]]
    assert "TransformControlsMessage" in kinds and "TransformControlsMessage" not in {
        m["type"] for m in shown
    }
    assert len(shown) == len(kinds) and any(m.get("name") == "/handle" for m in shown)
    before = [n for frame in plain for n in opened(frame)[1]]
    assert mesh.tobytes() in before and before == [n for frame in changed for n in opened(frame)[1]]


def test_a_frame_without_a_handle_is_the_very_same(server):
    server.scene.add_frame("/a")
    for frame in frames(server):
        assert for_onlooker(frame, dark=False) is frame


def test_viser_sends_the_whole_scene_to_somebody_who_says_nothing_and_does_not_count_him(server):
    server.scene.add_frame("/a")
    names = [m.get("name") for frame in frames(server) for m in opened(frame)[0]]
    assert "/a" in names and not server.get_clients()


@pytest.mark.parametrize("dark", [False, True])
def test_floor_and_background_are_those_of_who_looks_on(server, dark):
    """A trainer's dark page showed the white scene of a trainee whose page is light."""
    server.gui.configure_theme(dark_mode=not dark)
    lay_floor(server.scene, dark=not dark)
    shown = [m for frame in frames(server) for m in opened(for_onlooker(frame, dark=dark))[0]]
    (theme,) = [m for m in shown if m["type"] == "ThemeConfigurationMessage"]
    (floor,) = [m for m in shown if m.get("name") == "/floor" and m["type"] == "GridMessage"]
    assert theme["dark_mode"] is dark
    wanted = floor_colours(dark=dark)
    assert {name: tuple(floor["props"][name]) for name in wanted} == wanted
