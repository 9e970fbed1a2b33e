import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from app.errors import ActionRefusedError, FileFormatError, UnknownNameError
from app.session import Session, Store, replay
from app.session.actions import Delete, Move, Record
from app.session.journal import Journal
from app.session.store import find_journal
from tests.session.wizard import wizard_actions


@pytest.fixture
def taught(tmp_path):
    store = Store(tmp_path)
    session = store.create(robot="ur10e")
    for action in wizard_actions()[0]:
        session.do(action)
    return store, session


def test_a_journal_replays_to_the_very_same_result(taught):
    store, session = taught
    again, torn = replay(store.path(session.name))
    assert not torn
    assert np.array_equal(again.result.result.tool_point, session.state.result.result.tool_point)
    assert again.q == session.state.q and again.count == session.state.count


def test_a_refused_action_leaves_state_and_journal_untouched(taught):
    _, session = taught
    state, before = session.state, session.path.read_bytes()
    with pytest.raises(ActionRefusedError):
        session.do(Record("touch1"))
    assert session.state is state and session.path.read_bytes() == before


def test_a_torn_last_line_is_left_out_said_and_written_over(taught):
    store, session = taught
    session.close()
    path = session.path
    path.write_bytes(path.read_bytes()[:-7])
    state, torn = replay(path)
    assert torn and state.result is None and len(state.captures) == 6
    back = store.open(session.name)
    assert back.torn
    back.do(Delete("touch1"))
    assert not replay(path)[1]
    assert "touch1" not in replay(path)[0].captures


def test_every_cut_of_a_journal_is_a_session_as_it_was_then(taught):
    _, session = taught
    session.close()
    data = session.path.read_bytes()
    lines = data.count(b"\n")
    rng = np.random.default_rng(5)
    first = data.index(b"\n") + 1
    for cut in rng.integers(first, len(data), 25):
        session.path.write_bytes(data[:cut])
        state, torn = replay(session.path)
        assert state.count == data[:cut].count(b"\n") - 1 < lines
        assert torn == (data[cut - 1 : cut] != b"\n")


def test_a_file_whose_header_was_never_finished_begins_anew(tmp_path):
    path = tmp_path / "a" / "journal.jsonl"
    path.parent.mkdir()
    path.write_bytes(b'{"session":"a","crea')
    session = Session(Journal(path, "a"), robot="ur10e")
    session.do(Record("touch1"))
    assert "touch1" in replay(path)[0].captures


@pytest.mark.parametrize(
    "line, words",
    [
        (b"not json", "row 3"),
        (b'{"n":2,"t":0,"action":{"do":"fly"}}', "row 3"),
        (b'{"n":7,"t":0,"action":{"do":"undo"}}', "action number 7; expected 2"),
        (b'{"n":2,"t":0,"action":{"do":"calculate"}}', "not possible here"),
        (b'{"n":2,"t":0,"action":{"do":"move","q":["x"]}}', "row 3"),
    ],
)
def test_a_damaged_line_in_the_middle_names_its_row(tmp_path, line, words):
    session = Store(tmp_path).create(robot="ur10e")
    session.close()
    with session.path.open("ab") as file:
        file.write(line + b"\n")
    with pytest.raises(FileFormatError, match=words):
        replay(session.path)


@pytest.mark.parametrize("content", [b"", b"\x00\xff" * 50 + b"\n", b'{"format":"other"}\n', b"[]\n"])
def test_what_is_no_journal_is_said_in_one_line(tmp_path, content):
    path = tmp_path / "j.jsonl"
    path.write_bytes(content)
    with pytest.raises(FileFormatError) as caught:
        replay(path)
    assert "\n" not in str(caught.value) and "row 1" in str(caught.value)


def test_a_session_is_found_by_path_folder_name_and_the_beginning_of_its_name(taught, tmp_path):
    store, session = taught
    path = store.path(session.name)
    for text in (str(path), str(path.parent), session.name, session.name[:6]):
        assert find_journal(text, tmp_path) == path
    with pytest.raises(UnknownNameError, match=session.name):
        find_journal("nothing", tmp_path)
    assert [listed.name for listed in store.list()] == [session.name]


def test_only_names_the_store_gave_are_opened(taught):
    store, _ = taught
    for name in ("../../etc", "", "a" * 32, "x"):
        assert not store.has(name)


WRITER = """
import sys
from pathlib import Path
from app.session import Store
from app.session.actions import Move, Record, ReRecord
session = Store(Path(sys.argv[1])).create(robot="ur10e")
print(session.name, flush=True)
home = session.state.q
done = 1
while True:
    action = Move((home[0] + 0.001 * (done % 500), *home[1:]))
    session.do(action)
    done += 1
    print(done, flush=True)
"""


def test_what_was_confirmed_before_a_kill_is_there_after_it(tmp_path):
    """Killed with -9 at a moment nobody chose: every action that was confirmed is in the journal."""
    writer = subprocess.Popen(
        [sys.executable, "-c", WRITER, str(tmp_path)],
        stdout=subprocess.PIPE,
        text=True,
        cwd=Path.cwd(),
    )
    name = writer.stdout.readline().strip()
    rng = np.random.default_rng(int(time.time()) % 1000)
    lines = [writer.stdout.readline() for _ in range(int(rng.integers(20, 60)))]
    os.kill(writer.pid, signal.SIGKILL)
    rest = writer.stdout.read().splitlines()
    writer.wait()
    confirmed = int([line for line in [*lines, *rest] if line.strip().isdigit()][-1])
    session = Store(tmp_path).open(name)
    assert session.state.count >= confirmed
    session.do(Move(session.state.q))
    session.close()


def test_an_action_stands_in_the_journal_as_readable_json(taught):
    _, session = taught
    line = json.loads(session.path.read_text().splitlines()[2])
    assert line["n"] == 2 and line["action"]["do"] == "choose_robot"
