"""A server with accounts: a school of two classes, and browsers of their own."""

from contextlib import contextmanager
from dataclasses import dataclass

import pytest
from starlette.testclient import TestClient

from app.people import People
from app.session import Store
from app.shell.server import Shell
from app.workers.hub import Hub
from tests.people.conftest import PIN, school_of
from tests.shell.accounts.forms import come
from tests.shell.conftest import ADDRESS


@dataclass
class Served:
    """One server: its sessions, its accounts, who is in them, its routes; and opens browsers."""

    hub: Hub
    people: People
    school: dict
    shell: Shell

    def __post_init__(self):
        self._opened = []

    def browser(self, person=None, secret=PIN):
        client = TestClient(self.shell.app, base_url=ADDRESS, follow_redirects=False)
        if not self._opened:
            client.__enter__()  # begins the server's life, which ends with the first browser's
        self._opened.append(client)
        if person is not None:
            assert come(client, "/login", login=person.login, secret=secret).status_code == 303
        return client

    def close(self):
        if self._opened:
            self._opened[0].__exit__(None, None, None)
        self.hub.close()


@contextmanager
def serving(folder):
    """A server of its own with a school of its own."""
    hub = Hub(Store(folder), robot="ur10e", linger=30.0)
    people = People(hub.store.database)
    served = Served(hub, people, school_of(people), Shell(hub, "127.0.0.1", people=people))
    yield served
    served.close()


@pytest.fixture
def served(tmp_path):
    with serving(tmp_path) as served:
        yield served


@pytest.fixture
def hub(served):
    return served.hub


@pytest.fixture
def people(served):
    return served.people


@pytest.fixture
def school(served):
    return served.school


@pytest.fixture
def shell(served):
    return served.shell


@pytest.fixture
def browser(served):
    """Opens browsers of their own at one server."""
    return served.browser
