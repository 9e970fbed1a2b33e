"""Tables come from steps: of nothing, of what version 0.1.0 left, and never of a later version."""

import importlib
import re
import sqlite3
import subprocess
import sys
import threading
from contextlib import closing
from pathlib import Path

import pytest
from alembic.autogenerate import compare_metadata
from alembic.runtime.migration import MigrationContext
from sqlalchemy import create_engine, text
from sqlalchemy.engine import make_url

import app
from app.errors import InputError
from app.session import Store
from app.session.actions import Move
from app.session.database import FILE, METADATA, Database, sqlite_url
from app.session.migrations import steps
from app.session.owners import Owners
from app.training.records import Records
from tests.cli.running import assert_one_line, teachframe
from tests.session.postgresql import schema

#: Made by the code of 0.1.0: two sessions, one of them somebody's, one score.
RELEASE = (Path(__file__).parent / "release_0_1_0.sql").read_text(encoding="utf-8")
SESSION, OWNER = "056aa183682042acccef8d2ebf25715a", "a" * 64


def every_table():
    """METADATA once every module that adds to it is loaded."""
    root = Path(app.__file__).parent
    for path in root.rglob("*.py"):
        if "migrations" not in path.parts and re.search(
            r"^    METADATA,", path.read_text(encoding="utf-8"), re.M
        ):
            importlib.import_module(".".join(path.relative_to(root.parent).with_suffix("").parts))
    return METADATA


def released(folder, script=RELEASE):
    folder.mkdir(exist_ok=True)
    with closing(sqlite3.connect(folder / FILE)) as connection:
        connection.executescript(script)
    return folder


def differences(url):
    engine = create_engine(url)
    with engine.connect() as connection:
        found = compare_metadata(MigrationContext.configure(connection), every_table())
    engine.dispose()
    return found


def test_the_steps_make_the_tables_that_the_program_has(tmp_path):
    """Where this fails, a table or column has no step: add a file under app/session/migrations/versions."""
    Database(sqlite_url(tmp_path / FILE)).close()
    assert differences(sqlite_url(tmp_path / FILE)) == []


def test_on_postgresql_too(postgresql):
    with schema(postgresql) as url:
        Database(url).close()
        assert differences(make_url(url).set(drivername="postgresql+psycopg")) == []


def test_steps_are_numbered_without_a_gap_and_name_the_one_before():
    assert steps() == [f"{n:04d}" for n in range(1, len(steps()) + 1)]
    folder = Path(app.__file__).parent / "session" / "migrations" / "versions"
    before = "None"
    for path in sorted(folder.glob("[0-9]*.py")):
        source = path.read_text(encoding="utf-8")
        assert f"\ndown_revision = {before}\n" in source, path
        before = f'"{path.name[:4]}"'
        assert f"\nrevision = {before}\n" in source, path
        assert "app" not in re.findall(r"^(?:from|import) (\w+)", source, re.M), path


def test_what_0_1_0_left_is_taken_over_with_all_that_is_in_it(tmp_path):
    store = Store(released(tmp_path / "data"))
    assert store.state(SESSION).q == pytest.approx((0.1, -1.2, 1.3, -0.4, 0.5, 0.6))
    assert Owners(store.database).titles(OWNER) == {SESSION: "Monday's cell"}
    (card,) = Records(store.database).history(OWNER)
    assert card.total == 100.0
    store.open(SESSION).do(Move((0.0, -1.0, 1.0, 0.0, 0.0, 0.0)))
    Records(store.database).add(OWNER, SESSION, card)
    store.database.close()
    assert differences(sqlite_url(tmp_path / "data" / FILE)) == []


def test_0_1_0_made_tables_when_it_needed_them_so_some_may_be_missing(tmp_path):
    some = RELEASE[: RELEASE.index("CREATE TABLE owned")] + RELEASE[RELEASE.index("CREATE TABLE sessions") :]
    some = re.sub(r"CREATE INDEX .*?;", "", some)
    store = Store(released(tmp_path / "data", some))
    assert store.has(SESSION) and Owners(store.database).titles(OWNER) == {}
    store.database.close()


def test_what_0_1_0_left_on_postgresql_is_taken_over(postgresql, tmp_path):
    script = RELEASE[RELEASE.index("CREATE TABLE actions") : RELEASE.rindex("COMMIT")]
    script = script.replace("WITHOUT ROWID", "").replace("id INTEGER", "id SERIAL")
    with schema(postgresql) as url:
        engine = create_engine(make_url(url).set(drivername="postgresql+psycopg"))
        with engine.begin() as connection:
            connection.exec_driver_sql(script.replace("%", "%%"))
        engine.dispose()
        store = Store(tmp_path, url)
        assert store.state(SESSION).q[0] == pytest.approx(0.1)
        assert Owners(store.database).titles(OWNER) == {SESSION: "Monday's cell"}
        store.database.close()


def test_a_step_that_fails_leaves_the_database_as_it_was(tmp_path):
    folder = released(
        tmp_path / "data", RELEASE.replace("COMMIT;", "CREATE TABLE tries (x INTEGER); COMMIT;")
    )
    with pytest.raises(InputError, match="tries already exists"):
        Database(sqlite_url(folder / FILE))
    with closing(sqlite3.connect(folder / FILE)) as connection:
        tables = {
            name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")
        }
        assert tables == {"actions", "owned", "scores", "sessions", "tries"}
        assert connection.execute("PRAGMA user_version").fetchone() == (1,)


def test_a_later_version_is_refused_in_one_line(tmp_path, postgresql):
    store = Store(tmp_path)
    with store.database.begin() as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = '0099'"))
    store.database.close()
    assert_one_line(teachframe("sessions", "--data", tmp_path), "later version", "0099", "update teachframe")
    with schema(postgresql) as url:
        database = Database(url)
        with database.begin() as connection:
            connection.execute(text("UPDATE alembic_version SET version_num = '0099'"))
        database.close()
        said = teachframe("sessions", "--data", tmp_path / "x", "--database", url)
        assert_one_line(said, "later version", "0099")


def test_version_0_1_0_refuses_what_this_one_made(tmp_path):
    """It looks at SQLite's own number alone."""
    Database(sqlite_url(tmp_path / FILE)).close()
    with closing(sqlite3.connect(tmp_path / FILE)) as connection:
        assert connection.execute("PRAGMA user_version").fetchone()[0] == int(steps()[-1]) > 1


def test_several_programs_that_come_first_at_once_make_the_tables_once(tmp_path, postgresql):
    with schema(postgresql) as url:
        for address in (url, sqlite_url(tmp_path / FILE)):
            failed = []

            def come(to=address, failed=failed):
                try:
                    Database(to).close()
                except Exception as error:
                    failed.append(error)

            threads = [threading.Thread(target=come) for _ in range(6)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            assert not failed


def test_a_start_on_a_database_of_this_version_does_not_load_alembic(tmp_path):
    Database(sqlite_url(tmp_path / FILE)).close()
    code = (
        "import sys; from app.session import Store; from pathlib import Path;"
        f"Store(Path({str(tmp_path)!r})); sys.exit('alembic' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
