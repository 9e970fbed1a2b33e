"""The pendant in the browser."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path


@dataclass
class Command:
    """The pendant in the browser. Stop it with Ctrl-C; nothing that was recorded is lost."""

    host: str = "127.0.0.1"
    """Address to listen on; 0.0.0.0 lets other machines in (there is no login)."""
    port: int = 8080
    """Port to listen on; where it is taken, the next free one."""
    robot: str | None = None
    """The arm new sessions begin with (`teachframe robots` lists them)."""
    data: Path | None = None
    """Folder where sessions are kept; without it the user's own."""
    database: str | None = None
    """Another database for sessions and training records, by URL: postgresql://USER@HOST/NAME, sqlite:///FILE."""

    def run(self) -> int:
        from app.errors import InputError
        from app.kinematics import load_robot
        from app.pendant.server import PendantServer
        from app.session import Store

        if not 0 <= self.port <= 65535:
            raise InputError(f"port {self.port}", column="--port", expected="0 to 65535")
        if self.robot is not None:
            load_robot(self.robot)
        store = Store(self.data, self.database)
        server = PendantServer(store, host=self.host, port=self.port, robot=self.robot)
        if self.port not in (0, server.port):
            print(f"teachframe serve: port {self.port} is taken, using {server.port}", file=sys.stderr)
        print(f"Teachframe pendant: {server.address}", flush=True)
        print(f"sessions are kept in {store.database.name}; stop with Ctrl-C", file=sys.stderr, flush=True)
        try:
            server.wait()
        except KeyboardInterrupt:
            print("stopping", file=sys.stderr)
        finally:
            server.stop()
        return 0
