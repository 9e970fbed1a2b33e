"""One server and one Chromium for all browser tests of a process; each person has a session of his own."""

import shutil

import pytest

from app.session import Store
from app.session.motion import enabling, pace
from app.shell.server import PendantServer
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
#: The arm is so many times as quick: what is tried is not its speed.
BRISK = 6.0
PATIENT_S = 3.0  # a machine that draws by software and runs other tests beside


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


@pytest.fixture(scope="session")
def served(tmp_path_factory):
    server = PendantServer(Store(tmp_path_factory.mktemp("data")), port=0, linger=2.0)
    yield server
    server.stop()


@pytest.fixture
def brisk(monkeypatch):
    """A quick arm, and a switch that forgives a slow machine: for what is not about either."""
    monkeypatch.setattr(enabling, "SILENCE", PATIENT_S)
    monkeypatch.setattr(pace, "TIP_SPEED", BRISK * pace.TIP_SPEED)
    monkeypatch.setattr(pace, "TURN_SPEED", BRISK * pace.TURN_SPEED)


@pytest.fixture
def sit_down(chromium, served):
    """Opens a page for somebody: sit_down(robot=…, screen=…, context=…)."""
    contexts = []

    def open_(robot="ur10e", screen=SCREEN, context=None, touch=False):
        if context is None:
            context = chromium.new_context(viewport=screen, has_touch=touch)
            contexts.append(context)
        return Operator(context.new_page(), served, robot)

    yield open_
    for context in contexts:
        context.close()
