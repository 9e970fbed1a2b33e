"""Where a server listens, and what to open in a browser to find it."""

from __future__ import annotations

import socket

from app.shell.way import Way

_PORTS = 200  # ports tried after the one that was asked for


def address_of(host: str, port: int, way: Way) -> str:
    """What to open in a browser."""
    host = "127.0.0.1" if host in ("0.0.0.0", "") else host
    if ":" in host:
        host = f"[{host}]"
    return f"{'https' if way.certificate else 'http'}://{host}:{port}{way.prefix}"


def listen_at(host: str, port: int) -> socket.socket:
    """A socket on the port, or on the next that is free; raises OSError where none is."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    for candidate in [port] if port == 0 else range(port, min(port + _PORTS, 65536)):
        listening = socket.socket(family, socket.SOCK_STREAM)
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((host, candidate))
            listening.listen(128)
        except OSError:
            listening.close()
            if candidate == min(port + _PORTS, 65536) - 1 or port == 0:
                raise
            continue
        return listening
    raise OSError(f"no free port from {port}")
