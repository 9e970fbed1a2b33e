"""Firefox by its own protocol, WebDriver BiDi over a websocket: no driver is needed beside it."""

import json
import re
import shutil
import subprocess
import tempfile
import threading
from itertools import count
from pathlib import Path

from websockets.sync.client import connect

STARTING_S, ANSWER_S = 60.0, 60.0
_SAYS = re.compile(r"WebDriver BiDi listening on (ws://\S+)")
#: No first-run pages, no updates, nothing asked of anybody's server; the scene drawn by software.
_WISHES = {
    "browser.shell.checkDefaultBrowser": False,
    "browser.startup.homepage_override.mstone": "ignore",
    "datareporting.policy.dataSubmissionEnabled": False,
    "toolkit.telemetry.reportingpolicy.firstRun": False,
    "app.update.auto": False,
    "network.captive-portal-service.enabled": False,
    "webgl.force-enabled": True,
}


def firefox_path():
    """The system's Firefox, or None."""
    return next((path for name in ("firefox-esr", "firefox") if (path := shutil.which(name))), None)


class Firefox:
    """One headless Firefox with one page.

    Args:
        path: its program.
        width, height: of the page [px].
    """

    def __init__(self, path, width=1280, height=800):
        self._profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        wishes = "".join(f"user_pref({json.dumps(k)}, {json.dumps(v)});\n" for k, v in _WISHES.items())
        Path(self._profile.name, "user.js").write_text(wishes, encoding="utf-8")
        self._process = subprocess.Popen(
            [
                path,
                "--headless",
                "--no-remote",
                "--profile",
                self._profile.name,
                "--remote-debugging-port",
                "0",
            ],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        try:
            self._socket = connect(f"{self._address()}/session", max_size=None, open_timeout=STARTING_S)
            self._numbers = count(1)
            self.ask("session.new", capabilities={})
            tree = self.ask("browsingContext.getTree")
            self._page = tree["contexts"][0]["context"]
            size = {"width": width, "height": height}
            self.ask("browsingContext.setViewport", context=self._page, viewport=size)
        except BaseException:
            self.close()
            raise

    def _address(self):
        watch = threading.Timer(STARTING_S, self._process.kill)
        watch.start()
        try:
            for line in self._process.stderr:
                if found := _SAYS.search(line):
                    threading.Thread(target=self._process.stderr.read, daemon=True).start()
                    return found[1]
        finally:
            watch.cancel()
        raise RuntimeError("Firefox did not say where it listens")

    def ask(self, method, **params):
        """A command's result; raises RuntimeError with what Firefox says against it."""
        number = next(self._numbers)
        self._socket.send(json.dumps({"id": number, "method": method, "params": params}))
        while True:
            answer = json.loads(self._socket.recv(timeout=ANSWER_S))
            if answer.get("id") == number:
                if answer["type"] == "error":
                    raise RuntimeError(f"{method}: {answer['error']}: {answer['message']}")
                return answer["result"]

    def go(self, address):
        """Opens an address and waits until it has loaded."""
        self.ask("browsingContext.navigate", context=self._page, url=address, wait="complete")

    def run(self, script):
        """The value of a script's expression: numbers, texts, true, false, null."""
        answer = self.ask(
            "script.evaluate", expression=script, target={"context": self._page}, awaitPromise=True
        )
        if answer["type"] == "exception":
            raise RuntimeError(answer["exceptionDetails"]["text"])
        return answer["result"].get("value")

    def key(self, key, down):
        """A key goes down, or up."""
        self._act("key", "keyboard", [{"type": "keyDown" if down else "keyUp", "value": key}])

    def click(self, selector):
        """Presses what is in the middle of an element."""
        x, y = json.loads(
            self.run(
                f"""(() => {{ const one = document.querySelector({json.dumps(selector)});
                one.scrollIntoView({{block: "center"}}); const box = one.getBoundingClientRect();
                return JSON.stringify([Math.round(box.x + box.width / 2), Math.round(box.y + box.height / 2)]); }})()"""
            )
        )
        steps = [{"type": "pointerMove", "x": x, "y": y}]
        steps += [{"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}]
        self._act("pointer", "mouse", steps)

    def _act(self, kind, name, steps):
        self.ask(
            "input.performActions", context=self._page, actions=[{"type": kind, "id": name, "actions": steps}]
        )

    def picture(self, path):
        """Leaves a screenshot."""
        import base64

        data = self.ask("browsingContext.captureScreenshot", context=self._page)["data"]
        Path(path).write_bytes(base64.b64decode(data))

    def close(self):
        """Ends it."""
        self._process.terminate()
        try:
            self._process.wait(timeout=10.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._profile.cleanup()
