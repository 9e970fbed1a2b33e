"""What attackers know and do."""

from __future__ import annotations

import hashlib
import os
import secrets
import socket

from websockets.exceptions import WebSocketException

from app.people.doors import DOORS
from app.shell.security import COOKIE
from tests.hardening.hostile.asking import PIN

_SHORT = 1.0  # seconds somebody who sends what is no request waits for an answer


class Known:
    """What the attackers hold: a log-in of their own, and everything about a victim but his secrets."""

    def __init__(self, port, own, ended, victim, session, at, key_guess):
        self.port, self.own, self.ended, self.victim = port, own, ended, victim
        self.session, self.at, self.key_guess = session, at, key_guess


def _paths(known):
    """Every address of the table of doors, filled in with the victim's ids."""
    put = {
        "WHO": known.victim,
        "AT": known.at,
        "TOKEN": known.session,
        "LESSON": "1",
        "KEY": "x",
        "WIDGET": "1",
        "DROP": "d1",
    }
    for door in DOORS.values():
        for path in door.where:
            yield "/".join(put.get(part, part) for part in path.split("/"))


def private(known):
    """Those that nobody but the victim, his trainer or an administrator may enter."""
    mine = {"/login", "/join", "/login/outside", "/login/outside/back"}
    return sorted({p for p in _paths(known) if p not in mine})


def attacks(known):
    """Kinds of attack: each gives a function (ask, number) -> True where somebody was let in."""
    closed = private(known)
    others = [p for p in closed if known.victim in p or known.at in p or known.session in p]
    sockets = ["/words", "/scene"]
    foreign = [
        "https://evil.example",
        "null",
        f"http://127.0.0.1:{known.port}.evil.example",
        "http://127.0.0.1:1",
    ]
    here = f"http://127.0.0.1:{known.port}"

    def in_(status, content=b""):
        return status in (200, 204, 206, 101) and status != 0

    def forged(number):
        secret = secrets.token_urlsafe(32)
        own = known.own.partition("=")[2]
        return [
            f"{COOKIE}={secret}.{secrets.token_hex(32)}",
            f"{COOKIE}={secret}",
            f"{COOKIE}={own[:-1]}{'0' if own[-1] != '0' else '1'}",
            f"{COOKIE}={own.rpartition('.')[0][:-1]}x.{own.rpartition('.')[2]}",
            f"{COOKIE}={hashlib.sha256(own.encode()).hexdigest()}.{own.rpartition('.')[2]}",
            f"{COOKIE}={secret}.{hashlib.sha256((known.key_guess + secret).encode()).hexdigest()}",
            known.ended,
            "",
        ][number % 8]

    def without(ask, n):
        return in_(ask("GET", closed[n % len(closed)], cookie=forged(n // len(closed)))[0])

    def change_without(ask, n):
        path = closed[n % len(closed)]
        named = {"Origin": here, "Content_Type": "application/x-www-form-urlencoded"}
        return in_(ask("PUT" if "upload" in path else "POST", path, cookie=forged(n), body="a=1", **named)[0])

    def socket_without(ask, n):
        opened = ask.socket(sockets[n % 2], cookie=forged(n), origin=here)
        return _spoken(opened)

    def other_origin(ask, n):
        if n % 2:
            return _spoken(ask.socket(sockets[n // 2 % 2], cookie=known.own, origin=foreign[n % 4]))
        path = ["/logout", "/account/erase", "/account/export", "/account/secret"][n // 2 % 4]
        return in_(ask("POST", path, cookie=known.own, body="a=1", Origin=foreign[n % 4])[0])

    def other_host(ask, n):
        ask.host = ["evil.example", f"evil.example:{known.port}", "127.0.0.1.evil.example", "localhost.evil"][
            n % 4
        ]
        return in_(ask("GET", "/state", cookie=known.own)[0])

    def no_token(ask, n):
        path = ["/logout", "/account/erase", "/account/export", "/account/secret", "/account/join"][n % 5]
        named = {"Origin": here, "Content_Type": "application/x-www-form-urlencoded"}
        token = ["", "0" * 64, secrets.token_hex(32)][n % 3]
        return in_(ask("POST", path, cookie=known.own, body=f"token={token}&secret={PIN}", **named)[0])

    def others_ids(ask, n):
        path = others[n % len(others)]
        if n // len(others) % 2:
            named = {"Origin": here, "Content_Type": "application/x-www-form-urlencoded"}
            return in_(ask("POST", path, cookie=known.own, body="text=x", **named)[0])
        if path.endswith(("/words", "/scene")):
            return _spoken(ask.socket(path, cookie=known.own, origin=here))
        return in_(ask("GET", path, cookie=known.own)[0])

    def climbing(ask, n):
        up = ["/static/../server.py", "/static/%2e%2e/server.py", "/static/..%2f..%2fserver.py", "//etc/passwd",
              "/static/%00", "/static/\\..\\server.py",
              "/download/%2e%2e%2f", "/scene/?websocket=ws://evil.example"]  # fmt: skip
        status, _, content = ask("GET", up[n % len(up)], cookie=known.own)
        return in_(status) and (b"import" in content or b"root:" in content or "websocket" in up[n % len(up)])

    def guessing(ask, n):
        _, headers, page = ask("GET", "/login")
        form = (headers.get("Set-Cookie") or "").partition(";")[0]
        token = page.decode("utf-8", "replace").partition('name="token" value="')[2].partition('"')[0]
        named = {"Origin": here, "Content_Type": "application/x-www-form-urlencoded"}
        name = ["ada", "tom", "nobody", "%00", "a" * 3000][n % 5]
        body = f"token={token}&login={name}&secret={secrets.token_hex(4)}"
        status, headers, _ = ask("POST", "/login", cookie=form, body=body, **named)
        return status == 303

    def malformed(ask, n):
        kind = n % 5
        if kind == 0:
            return in_(
                ask(
                    "POST",
                    "/login",
                    body="x" * 200_000,
                    Origin=here,
                    Content_Type="application/x-www-form-urlencoded",
                )[0]
            )
        if kind == 1:
            return in_(ask("GET", "/account", cookie="a=" + "b" * 60_000)[0])
        if kind == 2:
            return in_(ask("PUT", "/upload/999999/abc?last=1", cookie=known.own, body="x", Origin=here)[0])
        raw = socket.create_connection(("127.0.0.1", known.port), _SHORT, (ask.address, 0))
        with raw:
            lines = {3: b"GET / HTTP/1.1\r\nHost\r\n\r\n", 4: os.urandom(200) + b"\r\n\r\n"}[kind]
            try:
                raw.sendall(lines)
                return raw.recv(200).startswith(b"HTTP/1.1 2")
            except OSError:
                return False

    def frames(ask, n):
        """At the attacker's own page: too large, no JSON, no words of ours. He is cut off or ignored."""
        opened = ask.socket("/words", cookie=known.own, origin=here)
        if opened is None:
            return False
        try:
            opened.send(
                [
                    "{" * 2000,
                    "x" * (2 << 20),
                    '{"t":"beat","en":1}',
                    b"\x00" * 100,
                    '{"t":"choose","what":"__class__","value":1}',
                ][n % 5]
            )
        except WebSocketException:
            pass
        finally:
            opened.close()
        return False

    def flood(ask, n):
        return in_(ask("GET", "/state")[0])

    return {
        "forged, stolen, ended cookies": (without, 3),
        "changes without a log-in": (change_without, 2),
        "sockets without a log-in": (socket_without, 1),
        "other origins": (other_origin, 2),
        "other hosts": (other_host, 1),
        "forms without their token": (no_token, 1),
        "other people's ids": (others_ids, 4),
        "climbing paths": (climbing, 1),
        "guessed passwords": (guessing, 1),
        "malformed and oversized": (malformed, 2),
        "malformed and oversized frames": (frames, 0.25),
        "floods": (flood, 2),
    }


def _spoken(opened) -> bool:
    """True where a socket not only opened but told something."""
    if opened is None:
        return False
    try:
        opened.recv(timeout=2.0)
        return True
    except (WebSocketException, TimeoutError):
        return False
    finally:
        opened.close()
