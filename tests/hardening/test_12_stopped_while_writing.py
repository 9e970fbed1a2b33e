"""SIGTERM while somebody works, a folder that nobody may write, a disk that was full: cleanly, and on again."""

import os
import signal
import subprocess
import sys
import textwrap

import pytest
from starlette.testclient import TestClient

from app.cli import run
from app.session import Store
from app.shell.server import Shell
from app.workers.hub import Hub
from tests.shell.started import Started

WRITES = """
import sys
from app.session import Store
from app.session.actions import ChooseMode
store = Store(__import__("pathlib").Path(sys.argv[1]))
session = store.create(robot="ur10e")
print(session.name, flush=True)
count = 0
while True:
    session.do(ChooseMode("touch", 3 + count % 4))
    count += 1
    print(count, flush=True)
"""
FULL = """
import resource, signal, sys
from pathlib import Path
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
from starlette.testclient import TestClient
from app.session import Store
from app.shell.server import Shell
from app.workers.hub import Hub
from tests.shell.started import Started
folder = Path(sys.argv[1])
hub = Hub(Store(folder), robot="ur10e")
with TestClient(Shell(hub, "127.0.0.1").app, base_url="http://127.0.0.1:8080") as client:
    sizes = [p.stat().st_size for p in folder.iterdir()]
    resource.setrlimit(resource.RLIMIT_FSIZE, (min(max(sizes), 4096), resource.RLIM_INFINITY))
    print("full", client.get("/").status_code, flush=True)
    resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    print("room", client.get("/").status_code, flush=True)
hub.close()
"""


def test_a_program_that_is_told_to_end_loses_nothing_it_had_confirmed(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-c", WRITES, str(tmp_path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    name = process.stdout.readline().strip()
    confirmed = [int(process.stdout.readline()) for _ in range(30)][-1]
    process.send_signal(signal.SIGTERM)
    rest = process.stdout.read()  # `communicate` would leave out lines that were taken from the pipe already
    process.communicate(timeout=60)
    confirmed = max([confirmed, *(int(line) for line in rest.split() if line.isdigit())])
    assert process.returncode == -signal.SIGTERM
    entries = Store(tmp_path).recorded(name).entries
    assert confirmed + 1 <= len(entries) <= confirmed + 2  # one may have been kept and not yet told


def test_a_served_pendant_that_is_told_to_end_says_nothing_and_ends(tmp_path):
    with Started(tmp_path) as server:
        server.stop()
        assert not any("Traceback" in line for line in server.said)
        assert server.process.returncode in (0, -signal.SIGTERM)


def test_a_new_browser_on_a_full_disk_is_told_and_gets_its_page_when_there_is_room(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(FULL), str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout.split() == ["full", "503", "room", "200"], done


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_nobody_may_write_is_told_in_one_line(tmp_path, capsys):
    tmp_path.chmod(0o500)
    assert run(["sessions", "--data", str(tmp_path)]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_read_only_database_is_told_and_the_page_comes_when_it_may_be_written(tmp_path):
    """As on a file system that was mounted read-only after an error; root, too, is refused by SQLite's own flag."""
    hub = Hub(Store(tmp_path), robot="ur10e")
    database = hub.store.database
    with TestClient(Shell(hub, "127.0.0.1").app, base_url="http://127.0.0.1:8080") as client:
        with database._engine.connect() as connection:
            connection.exec_driver_sql("PRAGMA query_only = ON")
        answer = client.get("/")
        assert answer.status_code == 503 and "readonly" in answer.text.replace("-", "").replace(" ", "")
        with database._engine.connect() as connection:
            connection.exec_driver_sql("PRAGMA query_only = OFF")
        assert client.get("/").status_code == 200
    hub.close()
