"""A journal as a file: what is exported, read again, cut short, damaged."""

import json

import numpy as np
import pytest

from app.errors import FileFormatError, UnknownNameError
from app.session import Session, Store, replay
from app.session.journal import encode_journal, read_journal
from app.session.store import JOURNAL, find_recorded
from tests.session.wizard import wizard_actions


@pytest.fixture
def taught(tmp_path):
    """A store, a session with a result, and the session as a file in a folder of its own."""
    store = Store(tmp_path / "data")
    session = store.create(robot="ur10e")
    for action in wizard_actions()[0]:
        session.do(action)
    path = tmp_path / "exported" / JOURNAL
    path.parent.mkdir()
    path.write_bytes(store.export(session.name))
    return store, session, path


def test_an_exported_journal_replays_to_the_very_same_result(taught):
    _, session, path = taught
    recorded = read_journal(path)
    again = replay(recorded)
    assert not recorded.torn and recorded.header.session == session.name
    assert np.array_equal(again.result.result.tool_point, session.state.result.result.tool_point)
    assert again.q == session.state.q and again.count == session.state.count


def test_every_cut_of_a_journal_is_a_session_as_it_was_then(taught):
    _, _, path = taught
    data = path.read_bytes()
    lines = data.count(b"\n")
    rng = np.random.default_rng(5)
    first = data.index(b"\n") + 1
    for cut in rng.integers(first, len(data), 25):
        path.write_bytes(data[:cut])
        recorded = read_journal(path)
        assert replay(recorded).count == data[:cut].count(b"\n") - 1 < lines
        assert recorded.torn == (data[cut - 1 : cut] != b"\n")


@pytest.mark.parametrize(
    "line, words",
    [
        (b"not json", "row 3"),
        (b'{"n":2,"t":0,"action":{"do":"fly"}}', "row 3"),
        (b'{"n":7,"t":0,"action":{"do":"undo"}}', "action number 7; expected 2"),
        (b'{"n":2,"t":0,"action":{"do":"calculate"}}', "row 3: this action is not possible here"),
        (b'{"n":2,"t":0,"action":{"do":"move","q":["x"]}}', "row 3"),
    ],
)
def test_a_damaged_line_in_the_middle_names_its_row(tmp_path, line, words):
    store = Store(tmp_path)
    path = tmp_path / "j.jsonl"
    path.write_bytes(store.export(store.create(robot="ur10e").name) + line + b"\n")
    with pytest.raises(FileFormatError, match=words):
        replay(read_journal(path))


@pytest.mark.parametrize("content", [b"", b"\x00\xff" * 50 + b"\n", b'{"format":"other"}\n', b"[]\n"])
def test_what_is_no_journal_is_said_in_one_line(tmp_path, content):
    path = tmp_path / "j.jsonl"
    path.write_bytes(content)
    with pytest.raises(FileFormatError) as caught:
        read_journal(path)
    assert "\n" not in str(caught.value) and "row 1" in str(caught.value)


def test_a_session_is_found_by_file_folder_name_and_the_beginning_of_its_name(taught):
    store, session, path = taught
    for text in (str(path), str(path.parent), session.name, session.name[:6]):
        assert find_recorded(text, store.folder).entries == read_journal(path).entries
    with pytest.raises(UnknownNameError, match=session.name):
        find_recorded("nothing", store.folder)


def test_asking_for_a_session_makes_no_data_folder(tmp_path):
    with pytest.raises(UnknownNameError):
        find_recorded("abc", tmp_path / "nowhere")
    assert not (tmp_path / "nowhere").exists()


def test_an_action_stands_in_the_journal_as_readable_json(taught):
    _, _, path = taught
    line = json.loads(path.read_text().splitlines()[2])
    assert line["n"] == 2 and line["action"]["do"] == "choose_robot"


def test_a_session_without_a_store_has_a_journal_too():
    session = Session(robot="ur10e")
    for action in wizard_actions()[0]:
        session.do(action)
    assert encode_journal(_header(), session.entries).count(b"\n") == len(session.entries) + 1


def _header():
    from app.session.journal import Header

    return Header("here", 0.0)
