"""PostgreSQL keeps what SQLite keeps: the store's own claims, the commands, and the server killed with -9."""

import json

import pytest

from app.cli import run
from app.errors import InputError, StorageError
from app.session import Store
from app.session.actions import Delete, Move
from app.session.database import Database
from app.training.exercise import exercise
from app.training.records import Records
from tests.session.postgresql import schema
from tests.session.test_store import (  # noqa: F401  collected here too, with the store of this file
    taught,
    test_a_refused_action_leaves_state_and_journal_untouched,
    test_a_session_opened_again_is_as_it_was_left,
    test_an_action_that_cannot_be_kept_does_not_count,
    test_an_action_whose_confirmation_was_lost_makes_room_for_the_next_one,
    test_journals_of_earlier_versions_are_taken_over_once,
    test_only_names_the_store_gave_are_opened,
    test_sessions_are_listed_the_newest_first_with_their_arm,
    test_two_writers_of_one_session_cannot_both_have_a_number,
)
from tests.shell.test_server_kills import KILLS, killed_while_teaching
from tests.training.test_score import GOOD

pytestmark = pytest.mark.xdist_group("pendant_server")


@pytest.fixture
def url(postgresql):
    with schema(postgresql) as own:
        yield own


@pytest.fixture
def store(tmp_path, url):
    store = Store(tmp_path, url)
    yield store
    store.database.close()


def test_commits_wait_for_the_disk(store):
    with store.database.begin() as connection:
        assert connection.exec_driver_sql("SHOW synchronous_commit").scalar() == "on"


def test_sessions_are_listed_replayed_exported_and_taken_in(store, url, taught, tmp_path, capsys):  # noqa: F811
    where = ["--data", str(tmp_path), "--database", url]
    assert run(["sessions", "--json", *where]) == 0
    assert json.loads(capsys.readouterr().out)["name"] == taught.name
    assert run(["replay", taught.name[:8], "--json", *where]) == 0
    found = capsys.readouterr().out
    assert json.loads(found)["delta_mm"] == pytest.approx(taught.state.result.result.delta * 1e3)
    out = tmp_path / "out.jsonl"
    assert run(["sessions", "--export", taught.name, "--out", str(out), *where]) == 0
    assert run(["replay", str(out), "--json"]) == 0
    assert capsys.readouterr().out == found
    assert run(["sessions", "--take", str(out), *where]) == 0
    name = capsys.readouterr().out.strip()
    assert store.open(name).entries == taught.entries


def test_scores_are_kept(store):
    records = Records(store.database)
    card = GOOD.scores(exercise("first_tool"), 3)
    records.add("Ada", "s", card)
    assert Records(store.database).history("Ada") == [card]
    assert records.has("s", card.begun) and not records.has("s", card.begun + 1e-6)


def test_a_connection_that_broke_is_made_again(store, url, taught):  # noqa: F811
    other = Database(url)
    with other.begin() as connection:
        mine = "application_name = current_setting('application_name') AND pid <> pg_backend_pid()"
        ended = connection.exec_driver_sql(
            f"SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE {mine}"
        )
        assert list(ended.scalars()) == [True]
    other.close()
    taught.do(Delete("touch1"))
    assert "touch1" not in store.state(taught.name).captures


def test_a_lock_another_program_holds_fails_in_one_line_and_changes_nothing(
    tmp_path, store, url, monkeypatch
):
    monkeypatch.setattr("app.session.database._BUSY", 0.3)
    hasty = Store(tmp_path, url)
    session = hasty.create(robot="ur10e")
    state = session.state
    with store.database.begin() as connection:
        connection.exec_driver_sql("LOCK TABLE actions IN ACCESS EXCLUSIVE MODE")
        with pytest.raises(StorageError, match="lock timeout") as caught:
            session.do(Move(state.q))
    assert "\n" not in str(caught.value) and session.state is state
    assert session.do(Move(state.q)).count == state.count + 1
    hasty.database.close()


def test_a_server_that_does_not_answer_is_said_in_one_line_without_the_password(tmp_path):
    with pytest.raises(InputError) as caught:
        Store(tmp_path, "postgresql://nobody:secret@127.0.0.1:1/none")
    assert "\n" not in str(caught.value) and "secret" not in str(caught.value)


def test_nothing_the_page_confirmed_is_lost_when_the_server_is_killed(tmp_path, url):
    assert killed_while_teaching(tmp_path, url, KILLS // 2) >= KILLS // 2
