"""The database's server killed under people at work, no room on the disk: nothing confirmed is lost, work goes on."""

import os
import shutil
import subprocess
import time
from pathlib import Path

import pytest

from app.session import Store
from tests.hardening.tree_kills import kill_trees
from tests.session import postgresql as clusters
from tests.shell.test_server_kills import STEPS
from tests.shell.test_workers import arrived, serving

pytestmark = pytest.mark.xdist_group("pendant_server")


@pytest.fixture
def cluster():
    """URL of a PostgreSQL of our own, and what kills and starts it."""
    programs = clusters._programs()
    if programs is None:
        pytest.skip("no PostgreSQL on this machine")
    with clusters.cluster(programs) as (url, call):
        yield url, call


def recorded(hand, step):
    """Presses record until the page shows it: a press that could not be kept is made again, as a person does."""
    end = time.monotonic() + 60
    while hand.rows().get(step) is not True:
        assert not hand.gone.is_set() and time.monotonic() < end
        hand.press_row(step, "record")
        time.sleep(0.5)


def test_a_database_server_that_is_killed_and_comes_back_loses_nothing(cluster, tmp_path):
    url, call = cluster
    with serving(tmp_path, "--database", url) as server:
        hand = arrived(server.port)
        assert hand.wait_for(lambda: bool(hand.read) and bool(hand.rows()))
        recorded(hand, STEPS[0])
        call("pg_ctl", "stop", "-w", "-m", "immediate")
        hand.press_row(STEPS[1], "record")
        time.sleep(2.0)
        assert hand.rows().get(STEPS[1]) is not True and server.process.poll() is None
        call("pg_ctl", "start", "-w")
        recorded(hand, STEPS[1])
        cookie = hand.cookie
        hand.close()
        hand = arrived(server.port, cookie)
        assert hand.wait_for(lambda: hand.rows().get(STEPS[0]) is True and hand.rows().get(STEPS[1]) is True)
        hand.close()
    store = Store(tmp_path, url)
    (session,) = store.names()
    assert set(store.state(session).captures) == set(STEPS[:2])
    store.database.close()


@pytest.fixture
def small(tmp_path):
    """A file system of 16 MB of its own: room for the database and its log."""
    folder = tmp_path / "small"
    folder.mkdir()
    if (
        os.geteuid() != 0
        or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16m", "none", folder]).returncode
    ):
        pytest.skip("only root mounts a small file system")
    yield folder
    subprocess.run(["umount", "-l", folder], check=True)


def test_a_full_disk_refuses_what_cannot_be_kept_and_goes_on_when_there_is_room(small):
    with serving(small) as server:
        hand = arrived(server.port)
        assert hand.wait_for(lambda: bool(hand.read) and bool(hand.rows()))
        recorded(hand, STEPS[0])
        filler = Path(small) / "filler"
        with filler.open("wb", buffering=0) as out:
            try:
                while True:
                    out.write(b"\0" * 4096)
            except OSError:
                pass
        assert shutil.disk_usage(small).free == 0
        for _ in range(40):  # what room the log has left is soon used up
            for step in STEPS[1:]:
                hand.press_row(step, "record")
                hand.press_row(step, "delete")
        time.sleep(3.0)
        assert server.process.poll() is None and not hand.gone.is_set()
        filler.unlink()
        for step in STEPS[1:]:
            recorded(hand, step)
        hand.close()
    store = Store(small)
    (session,) = store.names()
    assert set(store.state(session).captures) == set(STEPS)
    store.database.close()


def test_nothing_confirmed_is_lost_when_all_of_it_is_killed_at_once(tmp_path):
    count, _ = kill_trees(tmp_path, 2)
    assert count >= 2
