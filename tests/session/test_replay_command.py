import json

import pytest

from app.cli import run
from app.session import Store
from app.session.store import JOURNAL
from tests.session.wizard import wizard_actions


@pytest.fixture
def taught(tmp_path):
    """A session with a result, and the file it was exported to."""
    store = Store(tmp_path)
    session = store.create(robot="ur10e")
    for action in wizard_actions()[0]:
        session.do(action)
    session.close()
    path = tmp_path / "exported" / JOURNAL
    path.parent.mkdir()
    path.write_bytes(store.export(session.name))
    return session, path


def test_replay_prints_the_result_of_the_session(taught, capsys):
    assert run(["replay", str(taught[1])]) == 0
    out = capsys.readouterr()
    assert "tool point in the flange [mm]" in out.out and out.err == ""


def test_replay_gives_the_json_of_solve(taught, tmp_path, capsys):
    taught = taught[0]
    assert run(["replay", taught.name[:8], "--data", str(tmp_path), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["format"] == "teachframe.tool/1"
    assert found["delta_mm"] == pytest.approx(taught.state.result.result.delta * 1e3)


def test_a_torn_line_is_said_and_the_rest_replayed(taught, capsys):
    path = taught[1]
    path.write_bytes(path.read_bytes()[:-9])
    assert run(["replay", str(path.parent)]) == 0
    out = capsys.readouterr()
    assert "no result" in out.out and "not finished" in out.err


def test_without_a_result_json_is_bad_input(tmp_path, capsys):
    session = Store(tmp_path).create(robot="ur10e")
    session.close()
    assert run(["replay", session.name, "--data", str(tmp_path), "--json"]) == 2
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize("content", [None, b"", b"\x00" * 4096, b"touch,1,2\n"])
def test_what_is_no_session_is_one_line_and_exit_2(tmp_path, content, capsys):
    path = tmp_path / "some.jsonl"
    if content is not None:
        path.write_bytes(content)
    assert run(["replay", str(path), "--data", str(tmp_path)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
