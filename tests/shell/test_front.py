"""The front: who goes to which worker, what a worker is told, what is refused, what happens when one is gone."""

import asyncio
import contextlib
import subprocess

import pytest

from app.errors import InputError
from app.people.limits import Limit
from app.people.meter import Meter
from app.shell import front as fronts
from app.shell.floods import Flow
from app.shell.front import LARGEST_HEAD, Front
from app.shell.signing import signed
from app.shell.supervisor import _trusted

HERE = "127.0.0.1"


class Street:
    """A front before workers that say who they are and what they were told."""

    def __init__(self, folder, count=2, trusted=lambda _: False):
        self.paths = [folder / f"{n}.sock" for n in range(count)]
        self.up = [True] * count
        self.servers = {}
        self.front = Front(self.paths, lambda n: self.up[n], lambda p: p - 100, trusted, secure=False)

    async def __aenter__(self):
        for number in range(len(self.paths)):
            await self.start(number)
        self.server = await asyncio.start_server(self.front.serve, HERE, 0, limit=LARGEST_HEAD)
        self.port = self.server.sockets[0].getsockname()[1]
        return self

    async def __aexit__(self, *_):
        for server in (self.server, *self.servers.values()):
            server.close()

    async def start(self, number):
        async def serve(reader, writer):
            head = await reader.readuntil(b"\r\n\r\n")
            if b"/elsewhere" in head and number == 0 and b"X-Teachframe-Front: 1" in head:
                writer.write(b"HTTP/1.1 421 Misdirected Request\r\nX-Teachframe-Process: 101\r\n\r\n")
                writer.close()
                return
            given = f"Set-Cookie: teachframe=of{number}; Path=/\r\n" if b"teachframe=" not in head else ""
            writer.write(f"HTTP/1.1 200 OK\r\nX-Worker: {number}\r\n{given}\r\n".encode())
            if b"Upgrade:" in head or b"upgrade:" in head:
                with contextlib.suppress(OSError):
                    while piece := await reader.read(99):
                        writer.write(piece.upper())
            else:
                writer.write(head)
            writer.close()

        self.servers[number] = await asyncio.start_unix_server(serve, str(self.paths[number]))

    def stop(self, number):
        self.servers.pop(number).close()
        self.paths[number].unlink()

    async def ask(self, *headers, first="GET / HTTP/1.1", raw=None):
        """The whole answer, to the connection's end."""
        reader, writer = await asyncio.open_connection(HERE, self.port)
        writer.write(raw if raw is not None else "\r\n".join((first, "Host: x", *headers, "", "")).encode())
        answer = await asyncio.wait_for(reader.read(), 20)
        writer.close()
        return answer.decode()


def run(folder, story, **street):
    async def whole():
        async with Street(folder, **street) as made:
            await story(made)

    asyncio.run(whole())


def worker(answer):
    return int(answer.split("X-Worker: ")[1][0])


def test_requests_are_counted_for_all_workers_together(tmp_path):
    """By the cookie where it is signed, else by the address, which a trusted proxy says."""
    flow, by_proxy = Flow(b"key"), "X-Forwarded-For: 9.9.9.9"
    flow._known, flow._strange = Meter(Limit(4, 1e6)), Meter(Limit(3, 1e6))
    mine = f"Cookie: teachframe={signed(b'key', 'secret')}"

    async def story(street):
        street.front._flow = flow
        told = [await street.ask(f"Cookie: teachframe=forged{n}", by_proxy) for n in range(5)]
        assert [answer.split()[1] for answer in told] == ["200"] * 3 + ["429"] * 2
        assert {worker(answer) for answer in told[:3]} == {0, 1}
        assert (await street.ask("X-Forwarded-For: 8.8.8.8")).startswith("HTTP/1.1 200")
        told = [await street.ask(mine, by_proxy) for _ in range(5)]
        assert [answer.split()[1] for answer in told] == ["200"] * 4 + ["429"]

    run(tmp_path, story, trusted=_trusted(True))


def test_without_any_worker_the_page_comes_back_by_itself(tmp_path, monkeypatch):
    monkeypatch.setattr(fronts, "_WAIT", 0.3)

    async def story(street):
        for number in (0, 1):
            street.stop(number)
        answer = await street.ask("Cookie: teachframe=me")
        assert answer.startswith("HTTP/1.1 503") and "Refresh: 2" in answer and "示教器" in answer
        await street.start(1)
        assert worker(await street.ask("Cookie: teachframe=me")) == 1

    run(tmp_path, story)


def test_what_a_browser_says_of_its_own_address_is_replaced(tmp_path):
    forged = ("X-Forwarded-For: 9.9.9.9", "x-forwarded-proto: https", "Forwarded: for=9.9.9.9")

    async def story(street):
        told = await street.ask(*forged, "Connection: keep-alive, X-Forwarded-For", "Cookie: teachframe=a")
        assert "9.9.9.9" not in told and f"X-Forwarded-For: {HERE}" in told
        assert "X-Forwarded-Proto: http\r\n" in told and "keep-alive" not in told
        assert "Connection: close" in told

    run(tmp_path, story)


def test_a_proxys_word_is_taken_where_it_is_trusted(tmp_path, monkeypatch):
    async def story(street):
        told = await street.ask(
            "X-Forwarded-For: 9.9.9.9", "X-Forwarded-Proto: https", "Cookie: teachframe=a"
        )
        assert "X-Forwarded-For: 9.9.9.9" in told and HERE not in told

    run(tmp_path, story, trusted=_trusted(True))
    assert not _trusted(False)(HERE)
    monkeypatch.setenv("FORWARDED_ALLOW_IPS", "10.0.0.0/8, ::1")
    assert [_trusted(True)(peer) for peer in ("10.1.2.3", "::1", HERE)] == [True, True, False]
    monkeypatch.setenv("FORWARDED_ALLOW_IPS", "the proxy")
    with pytest.raises(InputError, match="FORWARDED_ALLOW_IPS"):
        _trusted(True)


@pytest.mark.parametrize(
    "raw",
    [
        b"GET / HTTP/1.1\r\nHost: x\r\n folded: 1\r\n\r\n",
        b"GET / HTTP/1.1\r\nHost : x\r\n\r\n",
        b"GET / HTTP/1.1\nHost: x\r\n\r\n",
        b"GET /\r\n\r\n",
        b"GET / HTTP/1.1\r\nx: \0\r\n\r\n",
        b"\x16\x03\x01 nonsense \r\n\r\n",
        b"GET / HTTP/1.1\r\nx: " + b"y" * 2 * LARGEST_HEAD + b"\r\n\r\n",
    ],
)
def test_what_is_no_request_is_refused_and_reaches_no_worker(tmp_path, raw):
    async def story(street):
        assert (await street.ask(raw=raw)).startswith("HTTP/1.1 400")

    run(tmp_path, story)


def test_who_says_nothing_is_not_waited_for(tmp_path, monkeypatch):
    monkeypatch.setattr(fronts, "_SLOW", 0.2)

    async def story(street):
        assert await street.ask(raw=b"GET / HT") == ""

    run(tmp_path, story)


def test_a_socket_goes_both_ways_and_ends_with_either_side(tmp_path):
    async def story(street):
        reader, writer = await asyncio.open_connection(HERE, street.port)
        writer.write(
            b"GET /words HTTP/1.1\r\nHost: x\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            b"Cookie: teachframe=me\r\n\r\n"
        )
        await reader.readuntil(b"\r\n\r\n")
        for word in (b"jog", b"stop"):
            writer.write(word)
            assert await asyncio.wait_for(reader.readexactly(len(word)), 5) == word.upper()
        writer.close()
        await asyncio.sleep(0.2)
        assert all(known.open == 0 for known in street.front.spread.known.values())

    run(tmp_path, story)


def test_tls_ends_at_the_front(tmp_path):
    from app.shell.supervisor import _tls
    from app.shell.way import Way
    from app.shell.worker import Plan

    key, certificate = tmp_path / "key.pem", tmp_path / "cert.pem"
    made = ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes"]
    made += ["-keyout", str(key), "-out", str(certificate), "-days", "2", "-subj", "/CN=localhost"]
    if subprocess.run(made, capture_output=True, check=False).returncode:
        pytest.skip("no openssl")
    way = Way((), "", certificate, key, False)

    async def story(street):
        import ssl

        street.front._secure = True
        server = await asyncio.start_server(
            street.front.serve, HERE, 0, ssl=_tls(Plan(None, None, HERE, way, None, False))
        )
        port = server.sockets[0].getsockname()[1]
        trusting = ssl.create_default_context(cafile=str(certificate))
        reader, writer = await asyncio.open_connection(HERE, port, ssl=trusting, server_hostname="localhost")
        writer.write(b"GET / HTTP/1.1\r\nHost: localhost\r\nCookie: teachframe=a\r\n\r\n")
        told = (await asyncio.wait_for(reader.read(), 10)).decode()
        assert "X-Forwarded-Proto: https" in told
        writer.close()
        server.close()

    run(tmp_path, story)


def test_what_another_worker_has_open_is_asked_for_there_once(tmp_path):
    """A trainer's page may come to another process than the trainee's arm is in."""
    socket = ("Upgrade: websocket", "Connection: Upgrade")

    async def story(street):
        street.front.spread.remember(fronts._key("me"), 0)
        reader, writer = await asyncio.open_connection(HERE, street.port)
        asked = ("GET /elsewhere HTTP/1.1", "Host: x", *socket, "Cookie: teachframe=me", "", "")
        writer.write("\r\n".join(asked).encode())
        told = (await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), 10)).decode()
        assert worker(told) == 1 and told.startswith("HTTP/1.1 200")
        writer.write(b"jog")
        assert await asyncio.wait_for(reader.readexactly(3), 5) == b"JOG"
        writer.close()
        assert worker(await street.ask("Cookie: teachframe=me")) == 0  # he himself stays where he is
        forged = await street.ask(
            "X-Teachframe-Front: 1", "Cookie: teachframe=me", first="GET /elsewhere HTTP/1.1"
        )
        assert worker(forged) == 0 and "Teachframe-Front" not in forged

    run(tmp_path, story)
