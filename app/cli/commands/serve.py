"""The pendant in the browser."""

from __future__ import annotations

import ipaddress
import signal
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import tyro

from app.cli.arguments import RobotArguments

if TYPE_CHECKING:
    from app.people import People
    from app.session import Store


_MOST_WORKERS = 64  # more serve nobody better on one machine


@dataclass
class Command:
    """The pendant in the browser. Stop it with Ctrl-C; nothing that was recorded is lost."""

    host: str = "127.0.0.1"
    """Address to listen on; 0.0.0.0 lets other machines in, which needs accounts (`teachframe people`)."""
    port: int = 8080
    """Port to listen on; where it is taken, the next free one."""
    arm: tyro.conf.OmitArgPrefixes[RobotArguments] = field(default_factory=RobotArguments)
    """The arm new sessions begin with (`teachframe robots` lists the shipped ones)."""
    data: Path | None = None
    """Folder where sessions are kept; without it the user's own."""
    database: str | None = None
    """Another database for sessions and training records, by URL: postgresql://USER@HOST/NAME, sqlite:///FILE."""

    name: tuple[str, ...] = ()
    """Host names that browsers come by, besides the address."""
    tls_cert: Path | None = None
    """TLS of its own: PEM file of the certificate with its chain."""
    tls_key: Path | None = None
    """PEM file of the certificate's key."""
    proxy_headers: bool = False
    """Behind a proxy on this machine: takes browsers' addresses and TLS from its X-Forwarded headers."""
    prefix: str = ""
    """Path under which a proxy shows the pendant, such as /teachframe."""
    workers: int = 1
    """Processes that serve; one is enough for twenty trainees. One that dies is started again, and its people go on."""

    oidc: str | None = None
    """Address of an OpenID Connect provider that vouches for people, such as https://login.school.example."""
    oidc_client: str | None = None
    """Id under which this server is known there."""
    oidc_secret: Path | None = None
    """File that holds the secret that goes with it."""

    def run(self) -> int:
        from app.errors import InputError
        from app.kinematics import load_robot
        from app.kinematics.solids import missing_meshes
        from app.session import Store
        from app.session.state import grant_robot
        from app.shell.listening import address_of, listen_at
        from app.shell.provider import Provider
        from app.shell.server import PendantServer
        from app.shell.way import Way

        if not 0 <= self.port <= 65535:
            raise InputError(f"port {self.port}", column="--port", expected="0 to 65535")
        if not 1 <= self.workers <= _MOST_WORKERS:
            raise InputError(f"found {self.workers}", column="--workers", expected=f"1 to {_MOST_WORKERS}")
        way = Way(self.name, self.prefix, self.tls_cert, self.tls_key, self.proxy_headers).checked()
        robot = self.arm.address
        if robot is not None:
            model = load_robot(robot)
            print(f"{model.name}: {model.joint_count} joints to its flange {model.flange}", file=sys.stderr)
            for line in missing_meshes(model):
                print(f"not drawn: {line}", file=sys.stderr)
            grant_robot(robot)
        store = Store(self.data, self.database)
        people = self._people(store)
        provider = self._provider(people)
        if self.workers > 1:
            from app.people.keys import server_key
            from app.shell.floods import Flow
            from app.shell.supervisor import Supervisor
            from app.shell.worker import Plan

            plan = Plan(self.data, self.database, self.host, way, robot, people is not None, provider)
            listening = listen_at(self.host, self.port)
            port = listening.getsockname()[1]
            flow = None if people is None else Flow(server_key(store.database))
            supervisor = Supervisor(plan, self.workers, listening, flow)
            self._say(port, address_of(self.host, port, way), store)
            store.database.close()
            supervisor.run()
            return 0
        server = PendantServer(
            store,
            host=self.host,
            port=self.port,
            people=people,
            way=way,
            provider=None if provider is None else Provider(*provider),
            robot=robot,
        )
        self._say(server.port, server.address, store)
        signal.signal(signal.SIGTERM, _stop)
        try:
            server.wait()
        except KeyboardInterrupt:
            print("stopping", file=sys.stderr)
        finally:
            server.stop()
        return 0

    def _provider(self, people: People | None) -> tuple[str, str, str] | None:
        """Who vouches: address, id, secret; raises InputError where something is missing."""
        from app.errors import InputError
        from app.files import read_bytes
        from app.shell.provider import Provider

        if self.oidc is None and self.oidc_client is None and self.oidc_secret is None:
            return None
        if self.oidc is None or self.oidc_client is None or self.oidc_secret is None:
            raise InputError("a provider has three parts", column="--oidc, --oidc-client, --oidc-secret")
        if people is None:
            raise InputError(
                "a provider needs accounts: make the first with `teachframe people add NAME --role administrator`",
                column="--oidc",
            )
        secret = (
            read_bytes(self.oidc_secret, 10_000, "the secret of a provider")
            .decode("utf-8", "replace")
            .strip()
        )
        Provider(self.oidc, self.oidc_client, secret)  # what cannot be one is told before anything is served
        return self.oidc, self.oidc_client, secret

    def _say(self, port: int, address: str, store: Store) -> None:
        """Where it is to be found, and where sessions are kept."""
        if self.port not in (0, port):
            print(f"teachframe serve: port {self.port} is taken, using {port}", file=sys.stderr)
        print(f"Teachframe pendant: {address}", flush=True)
        kept = store.database.file or store.database.name
        print(f"sessions are kept in {kept}; stop with Ctrl-C", file=sys.stderr, flush=True)

    def _people(self, store: Store) -> People | None:
        """The accounts, where there are some; without any, only browsers of this machine come in.

        Raises:
            InputError: others could come in, and nobody has an account.
        """
        from app.errors import InputError
        from app.people import People

        people = People(store.database)
        if people.any():
            return people
        if self.proxy_headers or self.name or not _of_this_machine(self.host):
            raise InputError(
                f"{self.host} lets other machines in, and nobody has an account yet: make the first with "
                "`teachframe people add NAME --role administrator` (same --data or --database)",
                column="--host",
            )
        return None


def _of_this_machine(host: str) -> bool:
    """True for an address that no other machine reaches; a name may mean anything but localhost."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host.lower() == "localhost"


def _stop(number: int, frame: object) -> None:
    """Whoever ends the process the polite way gets the same clean end as Ctrl-C."""
    raise KeyboardInterrupt
