"""One session for all cases of a file: each begins with its arm chosen anew."""

from dataclasses import replace

import pytest

from app.screens.look import Look
from app.session import Store
from app.session.actions import ChooseRobot
from app.session.motion import enabling, pace
from app.session.owners import owner_of
from app.workers.hub import Hub
from tests.desk import SECRET, Desk, plain


@pytest.fixture(scope="module")
def desk(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(enabling, "SILENCE", 1e6)
        patched.setattr(pace, "TIP_SPEED", 20.0 * pace.TIP_SPEED)
        patched.setattr(pace, "TURN_SPEED", 20.0 * pace.TURN_SPEED)
        hub = Hub(Store(tmp_path_factory.mktemp("data")), robot="jby50")
        desk = ToolDesk(hub.enter(owner_of(SECRET)))
        desk.drive.override = 1.0
        desk.idle()
        yield desk
        hub.close()


class ToolDesk(Desk):
    """The session, and what its tool screen says."""

    @property
    def tool(self):
        return self.view("deciding")

    def fresh(self, language="en", maker="", robot="jby50", rebuild=False):
        def job():
            self.context.look = Look(language, maker)
            self.context.do(ChooseRobot(robot))
            if rebuild:
                self.context.rebuild()

        self.does(job)
        return self

    def speak(self, **look):
        """Another language, another maker, another convention."""
        self.context.look = replace(self.context.look, **look)
        self.does(self.context.rebuild)

    def read(self):
        """What a person reads about a result or a refusal, without markup."""
        parts = (self.tool.deciding.light, self.tool.deciding.page, self.tool._refused)
        return plain(" ".join(part.content for part in parts if part.visible))
