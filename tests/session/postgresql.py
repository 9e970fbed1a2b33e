"""A PostgreSQL to test against: the one the environment names, else a cluster of our own while the tests last."""

import getpass
import os
import secrets
import shutil
import socket
import subprocess
import tempfile
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path

import pytest
from sqlalchemy import create_engine
from sqlalchemy.engine import make_url

GIVEN = "TEACHFRAME_TEST_POSTGRESQL"
_USER = "postgres"  # its server refuses to be run by root


@contextmanager
def any_postgresql():
    """URL of a database one may make schemas in; skips where there is neither driver nor server."""
    if find_spec("psycopg") is None:
        pytest.skip("no psycopg: pip install '.[postgresql]'")
    if given := os.environ.get(GIVEN):
        yield given
        return
    programs = _programs()
    if programs is None:
        pytest.skip(f"no PostgreSQL: ${GIVEN} is not set and there is no pg_ctl on this machine")
    with cluster(programs) as (url, _):
        yield url


@contextmanager
def schema(url):
    """The same database seen through an empty schema of its own, which goes with all that is in it.

    Connections are known to the server by the schema's name.
    """
    name = f"teachframe_{secrets.token_hex(6)}"
    engine = create_engine(make_url(url).set(drivername="postgresql+psycopg"), isolation_level="AUTOCOMMIT")
    with engine.connect() as connection:
        connection.exec_driver_sql(f"CREATE SCHEMA {name}")
    own = make_url(url).update_query_dict({"options": f"-csearch_path={name}", "application_name": name})
    yield own.render_as_string(hide_password=False)
    with engine.connect() as connection:
        connection.exec_driver_sql(f"DROP SCHEMA {name} CASCADE")
    engine.dispose()


def _programs():
    found = shutil.which("pg_ctl")
    folders = [Path(found).resolve().parent] if found else []
    folders += sorted(Path("/usr/lib/postgresql").glob("*/bin"), reverse=True)
    return next((f for f in folders if (f / "initdb").exists() and (f / "pg_ctl").exists()), None)


@contextmanager
def cluster(programs):
    """URL of a server of our own, and what calls its programs: `call("pg_ctl", "stop", "-m", "immediate")` kills it."""
    folder = Path(tempfile.mkdtemp(prefix="teachframe-pg-"))
    user = _USER if os.geteuid() == 0 else None
    if user is not None:
        shutil.chown(folder, user)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]

    def call(program, *arguments):
        command = [programs / program, "-D", folder / "data", *arguments]
        with (folder / "said").open("ab") as said:
            done = subprocess.run(command, user=user, cwd=folder, stdout=said, stderr=said)
        assert done.returncode == 0, (folder / "said").read_text()

    settings = f"port={port}\nlisten_addresses='127.0.0.1'\nunix_socket_directories='{folder}'\n"
    try:
        call("initdb", "--auth=trust", "--no-sync", "-E", "UTF8")
        with (folder / "data" / "postgresql.conf").open("a") as conf:
            conf.write(settings)
        call("pg_ctl", "start", "-w")
        try:
            yield f"postgresql://{user or getpass.getuser()}@127.0.0.1:{port}/postgres", call
        finally:
            call("pg_ctl", "stop", "-w", "-m", "immediate")
    finally:
        shutil.rmtree(folder, ignore_errors=True)
