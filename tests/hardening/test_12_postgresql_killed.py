"""PostgreSQL's own server dies and comes back: told in one line, what was confirmed stays, work goes on."""

from importlib.util import find_spec

import pytest
from starlette.testclient import TestClient

from app.errors import StorageError
from app.session import Store
from app.session.actions import ChooseMode
from app.shell.server import Shell
from app.workers.hub import Hub
from tests.session import postgresql

pytestmark = pytest.mark.xdist_group("pendant_server")
CONFIRMED = 20


class Cluster:
    """A server of our own, that dies and comes back."""

    def __init__(self, url, call):
        self.url, self._call = url, call

    def kill(self):
        self._call("pg_ctl", "stop", "-w", "-m", "immediate")

    def start(self):
        self._call("pg_ctl", "start", "-w")


@pytest.fixture(scope="module")
def cluster():
    programs = postgresql._programs() if find_spec("psycopg") else None
    if programs is None:
        pytest.skip("no psycopg, or no pg_ctl on this machine")
    with postgresql.cluster(programs) as (url, call):
        yield Cluster(url, call)


def test_what_was_confirmed_stays_and_the_session_goes_on(cluster, tmp_path):
    store = Store(tmp_path, cluster.url)
    session = store.create(robot="ur10e")
    for count in range(CONFIRMED):
        session.do(ChooseMode("touch", 3 + count % 4))
    state = session.state
    cluster.kill()
    with pytest.raises(StorageError) as caught:
        session.do(ChooseMode("direct"))
    assert "\n" not in str(caught.value) and session.state is state
    cluster.start()
    after = session.do(ChooseMode("plane"))
    assert store.state(session.name).mode == after.mode == "plane"
    assert (
        len(store.recorded(session.name).entries) == CONFIRMED + 2
    )  # the robot, and what was done afterwards
    store.database.close()


def test_a_browser_that_comes_meanwhile_is_told_and_gets_its_page_afterwards(cluster, tmp_path):
    hub = Hub(Store(tmp_path, cluster.url), robot="ur10e")
    with TestClient(Shell(hub, "127.0.0.1").app, base_url="http://127.0.0.1:8080") as client:
        cluster.kill()
        answer = client.get("/")
        assert answer.status_code == 503 and "<p>" in answer.text and "Traceback" not in answer.text
        cluster.start()
        assert client.get("/").status_code == 200
    hub.close()
