"""What holds for every test."""

import gc
from pathlib import Path

import pytest
from argon2 import PasswordHasher

from app.people import secret
from tests.session.postgresql import any_postgresql

BROWSER = Path(__file__).parent / "browser"
#: As people's are made: what is tried there is told apart from everywhere else.
AT_FULL_COST, NOBODY_AT_FULL_COST = secret._HASHER, secret._NOBODY


def shared_out(config):
    """True in one of several processes that share the tests by group."""
    return getattr(config.option, "loadgroup", False)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Where several processes share the tests, those of a file stay together: so does what they set up.

    Tests that drive a browser are where `make test` looks for them: what a run does not import costs it nothing.
    """
    for item in items:
        if item.get_closest_marker("xdist_group") is None:
            item.add_marker(pytest.mark.xdist_group(item.location[0]))
        if item.get_closest_marker("browser") is not None and BROWSER not in item.path.parents:
            raise pytest.UsageError(
                f"{item.nodeid}: `make test` looks for browser tests in tests/browser only"
            )
        if shared_out(config):
            _tells_its_group(item)


def _tells_its_group(item):
    """The group behind the test's id, by which pytest-xdist shares the tests out.

    pytest-xdist 3.8 writes it where pytest before 9.2 kept the id; with a later pytest it is lost without a word, and
    every process sets up what the tests of a file share.
    """
    group = item.get_closest_marker("xdist_group").args[0]
    if hasattr(item, "_id"):
        item._id = type(item._id).parse(f"{item.nodeid}@{group}")


def pytest_collection_finish(session):
    """What all tests have loaded is not looked through again whenever garbage is collected."""
    if shared_out(session.config) and not all(
        "@" in item.nodeid.rpartition("]")[2] for item in session.items
    ):
        raise pytest.UsageError("pytest no longer tells pytest-xdist which tests are to stay together")
    gc.collect()
    gc.freeze()


@pytest.fixture(scope="session", autouse=True)
def cheap():
    """Passwords and PINs are hashed at the least cost there is: tests are not about how long one takes."""
    hasher = PasswordHasher(1, 8, 1)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(secret, "_HASHER", hasher)
        patched.setattr(secret, "_NOBODY", hasher.hash("nobody's"))
        yield


@pytest.fixture(scope="session")
def postgresql():
    """URL of a server for all tests of this process; each makes a schema of its own."""
    with any_postgresql() as url:
        yield url
