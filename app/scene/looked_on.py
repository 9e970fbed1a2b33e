"""Frames of a scene for somebody who only looks on: without the drag handle, since he would move nothing with it, and
with floor and background as his own page is dark or light.

viser sends the whole scene to whoever connects, before he says anything, so nothing of what his page says has to reach
it: to viser he is no client with a camera, no handle hears him, and no page of its own looks where he looks.
"""

from __future__ import annotations

from typing import Any

import msgspec
import zstandard

from app.scene.ground import FLOOR, floor_colours

#: Head of a frame of viser 1.1.1: sizes of the packed words, unpacked and packed, little-endian; then those, then
#: plain numbers, aligned.
_HEAD, _ALIGNED = 16, 8
#: What a handle becomes: a frame nobody sees, so that whatever is said of it later still finds its node.
_UNSEEN = {
    "show_axes": False,
    "axes_length": 0.0,
    "axes_radius": 0.0,
    "origin_radius": 0.0,
    "origin_color": (0, 0, 0),
    "scale": 1.0,
}
_HANDLE, _THEME, _GRID = "TransformControlsMessage", "ThemeConfigurationMessage", "GridMessage"
#: What is changed; a frame with none of these is passed on as it is.
_CHANGED = tuple(name.encode() for name in (_HANDLE, _THEME, _GRID))


def for_onlooker(frame: bytes, *, dark: bool) -> bytes:
    """The frame as it is, or with an unseen node in place of a drag handle, and floor and background of his own.

    Args:
        dark: his page is dark.
    """
    size, packed = int.from_bytes(frame[:8], "little"), int.from_bytes(frame[8:_HEAD], "little")
    end = _HEAD + packed
    words = zstandard.ZstdDecompressor().decompress(frame[_HEAD:end], max_output_size=size)
    if not any(name in words for name in _CHANGED):
        return frame
    said: dict[str, Any] = msgspec.msgpack.decode(words)
    for message in said["messages"]:
        if message["type"] == _HANDLE:
            message["type"], message["props"] = "FrameMessage", _UNSEEN
        elif message["type"] == _THEME:
            message["dark_mode"] = dark
        elif message["type"] == _GRID and message["name"] == FLOOR:
            message["props"] |= floor_colours(dark=dark)
    changed = msgspec.msgpack.encode(said)
    again = zstandard.ZstdCompressor(level=1).compress(changed)
    numbers = frame[end + -end % _ALIGNED :]
    gap = b"\0" * (-(_HEAD + len(again)) % _ALIGNED) if numbers else b""
    return len(changed).to_bytes(8, "little") + len(again).to_bytes(8, "little") + again + gap + numbers
