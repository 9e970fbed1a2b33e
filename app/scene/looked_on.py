"""Frames of a scene for somebody who only looks on: the drag handle is left out, since he would move nothing with it.

viser sends the whole scene to whoever connects, before he says anything, so nothing of what his page says has to reach
it: to viser he is no client with a camera, no handle hears him, and no page of its own looks where he looks.
"""

from __future__ import annotations

from typing import Any

import msgspec
import zstandard

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
_HANDLE = "TransformControlsMessage"


def without_handle(frame: bytes) -> bytes:
    """The frame as it is, or with an unseen node in place of a drag handle."""
    size, packed = int.from_bytes(frame[:8], "little"), int.from_bytes(frame[8:_HEAD], "little")
    end = _HEAD + packed
    words = zstandard.ZstdDecompressor().decompress(frame[_HEAD:end], max_output_size=size)
    if _HANDLE.encode() not in words:
        return frame
    said: dict[str, Any] = msgspec.msgpack.decode(words)
    for message in said["messages"]:
        if message["type"] == _HANDLE:
            message["type"], message["props"] = "FrameMessage", _UNSEEN
    changed = msgspec.msgpack.encode(said)
    again = zstandard.ZstdCompressor(level=1).compress(changed)
    numbers = frame[end + -end % _ALIGNED :]
    gap = b"\0" * (-(_HEAD + len(again)) % _ALIGNED) if numbers else b""
    return len(changed).to_bytes(8, "little") + len(again).to_bytes(8, "little") + again + gap + numbers
