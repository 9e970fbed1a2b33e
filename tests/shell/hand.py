"""A person without a screen: a page's two sockets, its buttons, its held switch, over the network."""

import http.client
import json
import threading
import time

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

PATIENCE_S = 60.0
PROTOCOL = "viser-v1.1.1"


class Hand:
    """Connected until `close`, or until the server dies.

    Args:
        port: of the server.
        cookie: what a browser kept from an earlier visit.
        scene: opens the scene's socket, too; its frames go to `framed`.

    Attributes:
        read: the figures heard last; widgets: number -> widget; files: names and tokens.
        gone: set when the connection has ended.
    """

    def __init__(self, port, cookie=None, scene=False):
        self._port, self.cookie = port, cookie
        self.read, self.widgets, self.files = {}, {}, []
        self.gone, self._news, self._press = threading.Event(), threading.Condition(), 0
        self._page()
        address, headers = f"ws://127.0.0.1:{port}", {"Cookie": self.cookie}
        asked = {"origin": f"http://127.0.0.1:{port}", "additional_headers": headers, "max_size": None}
        self._words = connect(f"{address}/words", **asked)
        self._start(self._listen)
        self._scene = None
        if scene:
            self._scene = connect(f"{address}/scene", subprotocols=[PROTOCOL], **asked)
            self._start(self._watch)

    def _start(self, job):
        threading.Thread(target=job, daemon=True).start()

    def _page(self):
        asked = http.client.HTTPConnection("127.0.0.1", self._port, timeout=PATIENCE_S)
        asked.request("GET", "/", headers={"Cookie": self.cookie} if self.cookie else {})
        answer = asked.getresponse()
        answer.read()
        self.cookie = answer.headers["Set-Cookie"].split(";")[0]
        asked.close()

    def fetch(self, path):
        asked = http.client.HTTPConnection("127.0.0.1", self._port, timeout=PATIENCE_S)
        asked.request("GET", path, headers={"Cookie": self.cookie})
        content = asked.getresponse().read()
        asked.close()
        return content

    def say(self, **message):
        self._words.send(json.dumps(message))

    def press(self, label, value=None):
        """A widget by its label."""
        number = next(n for n, w in self.widgets.items() if w.get("label") == label)
        self.say(t="press", id=number, value=value)

    def press_row(self, row, action):
        """A button in a row of the list."""
        number = next(n for n, w in self.widgets.items() if w["kind"] == "rows")
        self.say(t="press", id=number, value=f"{row}/{action}")

    def rows(self):
        """row -> done or not."""
        found = next((w for w in self.widgets.values() if w["kind"] == "rows"), {})
        return {row["key"]: row.get("state") == "done" for row in found.get("rows", ())}

    def hold(self, seconds, axis=None, sign=1):
        """Holds the switch, and a button, for so long; then lets go."""
        self._press += 1
        end = time.monotonic() + seconds
        while time.monotonic() < end and not self.gone.is_set():
            self.say(
                t="beat", en=True, **({} if axis is None else {"axis": axis, "sign": sign}), press=self._press
            )
            time.sleep(0.03)
        self.say(t="beat", en=False)

    def wait_for(self, true):
        """Waits until something is so on the page; False where the connection ended before."""
        end = time.monotonic() + PATIENCE_S
        with self._news:
            while not true():
                if self.gone.is_set():
                    return False
                assert time.monotonic() < end, (
                    f"waited {PATIENCE_S:g} s; {self.rows()} {self.read.get('message')}"
                )
                self._news.wait(0.2)
        return True

    def close(self):
        self._words.close()
        if self._scene is not None:
            self._scene.close()

    def heard(self, text):
        """Every text of the page's socket."""

    def framed(self, frame):
        """Every frame of the scene's socket."""

    def _listen(self):
        try:
            for text in self._words:
                self.heard(text)
                with self._news:
                    self._take(json.loads(text))
                    self._news.notify_all()
        except ConnectionClosed:
            pass
        with self._news:
            self.gone.set()
            self._news.notify_all()

    def _take(self, message):
        kind = message["t"]
        if kind == "read":
            self.read = message
        elif kind == "panel":
            if message["whole"]:
                self.widgets = {}
            for number in message["removed"]:
                self.widgets.pop(number, None)
            self.widgets |= {w["id"]: w for w in message["widgets"]}
        elif kind == "file":
            self.files.append((message["name"], message["token"]))

    def _watch(self):
        try:
            for frame in self._scene:
                self.framed(frame)
        except ConnectionClosed:
            pass
