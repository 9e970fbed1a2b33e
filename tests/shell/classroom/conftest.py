"""A class with its trainer and two trainees, each with a browser of his own that is logged in."""

import re
from contextlib import ExitStack
from dataclasses import dataclass
from html import unescape

import pytest
from starlette.testclient import TestClient

from app.session import Store
from app.shell.server import Shell
from app.workers.hub import Hub
from tests.desk import Desk, patient, until  # noqa: F401

ADDRESS = "http://127.0.0.1:8080"
SOCKET = "ws://127.0.0.1:8080"
ORIGIN = {"origin": ADDRESS}
SECRET = "a long password"
PIN = "736251"


@dataclass
class Somebody:
    """A person with his browser."""

    person: object
    client: TestClient

    def get(self, path, status=200):
        answer = self.client.get(path, follow_redirects=False)
        assert answer.status_code == status, (path, answer.status_code, plain(answer.text)[:300])
        return answer

    def see(self, path, status=200):
        """The words of a page."""
        return plain(self.get(path, status).text)

    def post(self, path, status=303, token=None, **fields):
        """A form, with the token of a page of his."""
        answer = self.client.post(
            path,
            data={"token": self.token() if token is None else token, **fields},
            headers=ORIGIN,
            follow_redirects=False,
        )
        assert answer.status_code == status, (path, answer.status_code, plain(answer.text)[:300])
        return answer

    def token(self):
        return re.search(r'name="token" value="([0-9a-f]+)"', self.client.get("/account").text)[1]

    def socket(self, path, **more):
        return self.client.websocket_connect(f"{SOCKET}{path}", headers=ORIGIN, **more)


def plain(markup):
    return re.sub(r"\s+", " ", unescape(re.sub(r"<[^>]+>", " ", markup)))


@pytest.fixture
def hub(tmp_path, patient):  # noqa: F811
    hub = Hub(Store(tmp_path), robot="ur10e", linger=30.0)
    yield hub
    hub.close()


@pytest.fixture
def people(hub):
    return hub.room.people


@pytest.fixture
def come_in(hub, people):
    """Somebody logs in; without a person a browser of nobody."""
    app = Shell(hub, "127.0.0.1", people=people).app
    with ExitStack() as stack:

        def come(person=None):
            client = TestClient(app, base_url=ADDRESS)
            stack.callback(client.close)
            if person is not None:
                token = re.search(r'name="token" value="([0-9a-f]+)"', client.get("/login").text)[1]
                secret = PIN if "@" in person.login else SECRET
                form = {"token": token, "login": person.login, "secret": secret}
                answer = client.post("/login", data=form, headers=ORIGIN, follow_redirects=False)
                assert answer.status_code == 303 and answer.headers["location"].endswith("/"), answer.text
            return Somebody(person, client)

        yield come


@pytest.fixture
def trainer(people, come_in):
    return come_in(people.add("tim", "Tim", "trainer", SECRET))


@pytest.fixture
def at(people, trainer):
    return people.classes.make("Monday", trainer.person.id)


@pytest.fixture
def ada(people, at, come_in):
    return come_in(people.join(at.code, "Ada", PIN, "127.0.0.1"))


@pytest.fixture
def bo(people, at, come_in):
    return come_in(people.join(at.code, "Bo", PIN, "127.0.0.1"))


@pytest.fixture
def seated(hub, ada):
    """Ada's session is open, with a page."""
    desk = Desk(hub.enter(ada.person.owner, None, ada.person))
    hub.arrive(desk.live, desk)
    desk.drive.override = 1.0
    desk.idle()
    return desk
