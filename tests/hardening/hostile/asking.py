"""Requests as anybody may send them, and a log-in as a browser makes it."""

from __future__ import annotations

import http.client

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

from app.shell.security import COOKIE

PASSWORD, PIN = "correct horse battery", "482915"
_LONG = 30.0  # seconds an answer may take before it counts as lost


class Asking:
    """One request: status, headers and content of the answer; 0 where the connection was closed on it."""

    def __init__(self, port: int, address: str = "127.0.0.1"):
        self.port, self.address = port, address
        self.host = f"127.0.0.1:{port}"

    def __call__(self, method, path, *, cookie="", body=None, **headers):
        asked = http.client.HTTPConnection(
            "127.0.0.1", self.port, timeout=_LONG, source_address=(self.address, 0)
        )
        head = {"Host": self.host, **({"Cookie": cookie} if cookie else {})}
        head |= {name.replace("_", "-"): value for name, value in headers.items()}
        try:
            asked.request(method, path, body, head)
            answer = asked.getresponse()
            return answer.status, answer.headers, answer.read()
        except (OSError, http.client.HTTPException):
            return 0, http.client.HTTPMessage(), b""
        finally:
            asked.close()

    def socket(self, path, *, cookie="", origin=None):
        """A socket that was opened, or None."""
        try:
            return connect(
                f"ws://{self.host}{path}",
                additional_headers={"Cookie": cookie} if cookie else {},
                origin=origin,
                open_timeout=_LONG,
                source_address=(self.address, 0),
                subprotocols=["viser-v1.1.1"] if path.endswith("scene") else None,
            )
        except (OSError, WebSocketException):
            return None


def log_in(port: int, login: str, secret: str, address: str = "127.0.0.1") -> str:
    """A cookie, as a browser gets one."""
    ask = Asking(port, address)
    _, headers, page = ask("GET", "/login")
    form = headers["Set-Cookie"].partition(";")[0]
    token = page.decode().partition('name="token" value="')[2].partition('"')[0]
    body = (
        f"token={token}&login={login.replace(' ', '+').replace('@', '%40')}&secret={secret.replace(' ', '+')}"
    )
    named = {"Content_Type": "application/x-www-form-urlencoded", "Origin": f"http://{ask.host}"}
    status, headers, _ = ask("POST", "/login", cookie=form, body=body, **named)
    assert status == 303, status
    return next(c.partition(";")[0] for c in headers.get_all("Set-Cookie") if c.startswith(f"{COOKIE}="))
