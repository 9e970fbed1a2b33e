"""A pendant on a free port, and a Chromium in front of it."""

import shutil

import pytest

from app.pendant.server import PendantServer
from app.session import Store
from tests.browser.operator import Operator

FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
]
SCREEN = {"width": 1280, "height": 800}


def chromium_path():
    """The system's Chromium, or None."""
    found = (shutil.which(name) for name in ("chromium", "chromium-browser", "google-chrome"))
    return next((path for path in found if path), None)


@pytest.fixture(scope="session")
def chromium():
    from playwright.sync_api import sync_playwright

    path = chromium_path()
    if path is None:
        pytest.fail("no Chromium: `make test` installs it as root; elsewhere install the package `chromium`")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield browser
        browser.close()


@pytest.fixture
def serve(tmp_path):
    """Starts a pendant: serve(world_of=…, robot=…)."""
    servers = []

    def start(**arguments):
        server = PendantServer(Store(tmp_path / "data"), port=0, **arguments)
        servers.append(server)
        return server

    yield start
    for server in servers:
        server.stop()


@pytest.fixture
def sit_down(chromium):
    """Opens a browser in front of a server and gives the person who sits there."""
    contexts = []

    def open_(server, context=None, screen=SCREEN):
        if context is None:
            context = chromium.new_context(viewport=screen)
            contexts.append(context)
        return Operator(context.new_page(), server)

    yield open_
    for context in contexts:
        context.close()
