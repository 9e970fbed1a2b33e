"""A browser without a screen: speaks viser's websocket, answers what is asked, throws away what is drawn."""

from __future__ import annotations

import threading
from importlib.metadata import version
from typing import Any

import msgspec
import zstandard
from websockets.sync.client import connect

_TOKEN = "teachframe.session"


class Browser:
    """Connected until `close`.

    Args:
        port: of a server on this machine.
        token: the session this browser remembers; None is a browser that was never here.
    """

    def __init__(self, port: int, token: str | None = None):
        self._kept: dict[str, str | None] = {_TOKEN: token}
        self.received = 0
        self._socket = connect(
            f"ws://127.0.0.1:{port}",
            subprotocols=[f"viser-v{version('viser')}"],  # type: ignore[list-item]
            max_size=None,
            compression=None,
        )
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()
        self.look()  # viser greets a browser once it says where it looks from

    def look(self) -> None:
        """Says where it looks from."""
        self.send(
            "ViewerCameraMessage",
            wxyz=(1.0, 0.0, 0.0, 0.0),
            position=(2.0, 2.0, 2.0),
            fov=0.8,
            near=0.01,
            far=100.0,
            image_height=800,
            image_width=600,
            look_at=(0.0, 0.0, 0.0),
            up_direction=(0.0, 0.0, 1.0),
        )

    @property
    def token(self) -> str | None:
        """The session this browser remembers now."""
        return self._kept[_TOKEN]

    def send(self, kind: str, **fields: Any) -> None:
        """One message to the server."""
        self._socket.send(msgspec.msgpack.encode({"type": kind, **fields}))

    def close(self) -> None:
        self._socket.close()
        self._thread.join(timeout=2.0)

    def _listen(self) -> None:
        unpack = zstandard.ZstdDecompressor()
        try:
            for data in self._socket:
                if not isinstance(data, bytes):
                    continue
                self.received += 1
                if b"LocalStorage" not in (text := self._text(data, unpack)):
                    continue
                for message in msgspec.msgpack.decode(text)["messages"]:
                    self._answer(message)
        except Exception:
            return

    def _text(self, data: bytes, unpack: zstandard.ZstdDecompressor) -> bytes:
        size, packed = int.from_bytes(data[:8], "little"), int.from_bytes(data[8:16], "little")
        return unpack.decompress(data[16 : 16 + packed], max_output_size=size)

    def _answer(self, message: dict[str, Any]) -> None:
        if message["type"] == "LocalStorageGetItemRequestMessage":
            self.send(
                "LocalStorageGetItemResponseMessage",
                value=self._kept.get(message["key"]),
                error=None,
                request_uuid=message["request_uuid"],
            )
        elif message["type"] == "LocalStorageSetItemMessage":
            self._kept[message["key"]] = message["value"]
