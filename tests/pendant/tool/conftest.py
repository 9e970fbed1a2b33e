"""One pendant for all cases of a file: each begins with its arm chosen anew."""

import re
from html import unescape

import pytest

from app.pendant.server import PendantServer
from app.session import Store
from app.session.actions import ChooseRobot
from benchmarks._browser import Browser
from tests.pendant.test_server import until


@pytest.fixture(scope="module")
def desk(tmp_path_factory):
    server = PendantServer(Store(tmp_path_factory.mktemp("data")), port=0, robot="jby50")
    browser = Browser(server.port, None)
    until(lambda: server.pendants, "the pendant")
    pendant = server.pendants[0]
    until(lambda: hasattr(pendant, "page") and pendant.worker.idle(0.05), "the page")
    yield Desk(pendant)
    browser.close()
    server.stop()


class Desk:
    """The pendant, and what its tool screen says."""

    def __init__(self, pendant):
        self.pendant = pendant

    @property
    def view(self):
        return next(view for view in self.pendant.page._views if hasattr(view, "_next_touch"))

    @property
    def state(self):
        return self.pendant.session.state

    def does(self, job):
        """A job on the worker, done when this returns."""
        self.pendant.post(job)
        assert self.pendant.worker.idle()

    def fresh(self, language="en", maker="", robot="jby50", rebuild=False):
        def job():
            self.pendant.language, self.pendant.vocabulary, self.pendant.convention = language, maker, "ZYX"
            self.pendant.do(ChooseRobot(robot))
            if rebuild:
                self.pendant.rebuild()

        self.does(job)
        return self

    def shown(self):
        """What a person reads about a result or a refusal, without markup."""
        parts = (self.view.deciding.light, self.view.deciding.page, self.view._refused)
        return plain(" ".join(part.content for part in parts if part.visible))


def plain(markup):
    """Markup as text."""
    return re.sub(r"\s+", " ", unescape(re.sub(r"<[^>]+>", " ", markup)))
