"""A browser that comes while the database is locked is told why, and gets its page as soon as it is free."""

import sqlite3

import pytest
from starlette.testclient import TestClient

from app.session import Store
from app.session.database import FILE
from app.shell.server import Shell
from app.shell.unavailable import AGAIN
from app.workers.hub import Hub


@pytest.fixture
def client(tmp_path):
    hub = Hub(Store(tmp_path), robot="ur10e")
    with TestClient(Shell(hub, "127.0.0.1").app, base_url="http://127.0.0.1:8080") as client:
        yield client


def test_a_locked_database_gives_a_reason_and_then_the_page(client, tmp_path):
    other = sqlite3.connect(tmp_path / FILE, isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    answer = client.get("/")
    assert answer.status_code == 503 and "locked" in answer.text
    assert answer.headers["Retry-After"] == str(AGAIN) and f'content="{AGAIN}"' in answer.text
    other.execute("ROLLBACK")
    other.close()
    assert client.get("/").status_code == 200
