"""What a screen gets: the session, the arm's drive, the scene, the panel, the operator's language."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from app.errors import StorageError, TeachframeError, one_line
from app.geometry import Pose
from app.kinematics import IkResult, RobotModel
from app.panel import Panel
from app.scene.instead import Instead, Seen
from app.scene.server import SceneServer
from app.scene.stage import Stage
from app.screens.exercising import aids_of, cell_key
from app.screens.hearing import Hearing
from app.screens.look import Look
from app.screens.meeting import meeting
from app.screens.shelf import Shelf
from app.screens.spoken import Line, Spoken
from app.session import AnyAction, Session, SessionState
from app.session.cell import cell_of
from app.session.motion.drive import Drive
from app.session.motion.following import Following
from app.session.motion.jogging import Jogging
from app.session.motion.worker import Job, Worker
from app.session.state import as_tuple, robot_named
from app.simulation.world import World
from app.texts import error_text
from app.training.cell import world_of

_LOG = logging.getLogger(__name__)
_LOG_LENGTH = 200
_SHOWN = 0.2  # seconds between two updates of a screen's numbers while the arm moves


class Context:
    """Everything a screen may use. Its methods belong to the worker's thread unless they say otherwise.

    Args:
        session: whose state is shown.
        server: of the session's scene.
        shelf: all sessions.
        usual_world: the cell of an arm.
        look: how the page looks and speaks.
        build: makes all screens anew.
        send: gives the page a file: name and content.
    """

    def __init__(
        self,
        session: Session,
        server: SceneServer,
        shelf: Shelf,
        usual_world: Callable[[RobotModel], World],
        look: Look,
        build: Callable[[Context], list[Any]],
        send: Callable[[str, bytes], None],
    ):
        self.session, self.shelf, self.look = session, shelf, look
        self._server, self._usual_world, self._build, self.send = server, usual_world, build, send
        self.aids = aids_of(session.state)
        self.log, self.spoken = list[Line](), Spoken()
        self.trainee, self.exercise = "", ""
        self.demonstrated: int | None = None  # points a demonstration has shown so far; None where none plays
        self.seen: Seen | None = None  # an arm that is seen instead of the own
        self.ui, self.views = Panel(), []
        self.rng = np.random.default_rng(abs(hash(session.name)) if session.name else 0)
        self.worker = Worker(f"session-{session.name[:8]}", self.around)
        hearing = Hearing(self.worker)
        self.clicked, self.chosen = hearing.clicked, hearing.chosen
        self.changed, self.uploaded = hearing.changed, hearing.uploaded
        self.drive = Drive(session, self._own_world(), self.worker, self, self._moved, self.numbers)
        self.jogging = Jogging(self.drive)
        self.following = Following(self.drive, self._handle_back)
        self.wanted_screen = ""  # a screen the page is asked to open
        self.open_screen = "tool"  # the one that is open there
        self.on_page: Callable[[], None] = lambda: None  # something the page shows has changed; any thread
        self._numbers_at = 0.0
        self.stage = self._make_stage()

    # The session ------------------------------------------------------------------------------------------

    @property
    def model(self) -> RobotModel:
        """The arm that is shown."""
        return robot_named(self.session.state.robot)

    @property
    def world(self) -> World:
        """The cell."""
        return self.drive.world

    @property
    def q(self) -> np.ndarray:
        """(n,) where the arm stands."""
        return self.drive.q

    @property
    def language(self) -> str:
        """Of all texts."""
        return self.look.language

    @property
    def vocabulary(self) -> str:
        """Key of the maker whose words are used; empty for none."""
        return self.look.vocabulary

    @property
    def convention(self) -> str:
        """Key of the angles shown."""
        return self.look.convention

    def do(self, action: AnyAction) -> SessionState:
        """An action on the session; every screen is refreshed. Raises ActionRefusedError, which `say`s itself."""
        self.drive.settle()
        before = self.session.state
        state = self.session.do(action)
        if state.robot != before.robot or (state.running is None) != (before.running is None):
            self.drive.cancel()
            self.drive.q, self.aids = np.array(state.q), aids_of(state)
            self.drive.world = self._own_world()
            self.rebuild()
        else:
            self.refresh()
        return state

    # Words ------------------------------------------------------------------------------------------------

    def t(self, key: str, **fields: Any) -> str:
        """A text in the operator's language; from any thread."""
        return self.spoken.text(key, self.look.language, fields)

    def say(self, level: str, words: str) -> None:
        """The message line, and the log: `info`, `good`, `warning`, `error`; from any thread."""
        self.log.append((time.time(), level, words))
        del self.log[:-_LOG_LENGTH]
        self.on_page()

    # What somebody does on the panel ------------------------------------------------------------------------

    def post(self, job: Job) -> None:
        """Puts a job into the worker's queue; from any thread."""
        self.worker.post(job)

    def background(self, job: Callable[[], Any], done: Callable[[Any], object]) -> None:
        """Long work on a thread of its own; `done` gets its result on the worker. From any thread."""

        def run() -> None:
            try:
                result = job()
            except Exception as error:
                self.post(lambda error=error: self._tell(error))
            else:
                self.post(lambda: done(result))

        threading.Thread(target=run, name="pendant-background", daemon=True).start()

    def open(self, screen: str) -> None:
        """Asks the page to open a screen."""
        self.wanted_screen = screen
        self.on_page()

    def opened(self, screen: str) -> None:
        """A screen is open at the page: what it proposes is seen in the scene."""
        self.open_screen = screen
        self.stage.next_arm.look(screen)

    # The arm ----------------------------------------------------------------------------------------------

    def go(self, q: np.ndarray, then: Job | None = None, errand: str = "") -> None:
        """The arm moves to q while the enabling switch is held; what it is for is told meanwhile."""
        self.drive.go(q, then, errand)

    def hand(self, q: np.ndarray | None = None) -> Pose:
        """T_base_tool as the controller reckons it."""
        return self.drive.hand(q)

    def why(self, result: IkResult) -> str:
        """Why the arm did not get further."""
        return self.drive.why(result)

    # What is shown ----------------------------------------------------------------------------------------

    def allow(self, aids: Any) -> None:
        """Gives these aids and no others; everything is made anew."""
        if aids != self.aids:
            self.aids = aids
            self.rebuild()

    def refresh(self) -> None:
        """Shows the session's state everywhere."""
        state = self.session.state
        if as_tuple(self.q) != state.q:
            self.drive.show(np.array(state.q))
        else:
            self.stage.hold(self.hand())  # another tool may have been accepted
        if any(a is not b for a, b in zip(cell_key(state), self._source, strict=True)):
            self.drive.world = self._own_world()
            self.stage.cell(self.world)
        self.stage.refresh(state)
        for view in self.views:
            view.refresh(state)
        self.numbers()

    def numbers(self) -> None:
        """The arm moved: screens that say so follow."""
        self._numbers_at = time.monotonic()
        for view in self.views:
            numbers = getattr(view, "numbers", None)
            if numbers is not None:
                numbers()
        self.stage.bodies(*meeting(self.drive, self.aids.light))
        self.stage.follow()
        self.on_page()

    def rebuild(self) -> None:
        """Makes panels and scene anew: another arm, another language."""
        self.worker.halt()
        self.seen = None
        self.close_views()
        self.ui.reset()
        self._server.scene.reset()
        self.stage = self._make_stage()
        self.build()

    def build(self) -> None:
        """Makes the screens."""
        self.views = self._build(self)
        self.drive.show(self.q)
        self.refresh()

    def show_instead(self, seen: Seen | None, instead: Callable[[], Instead] | None = None) -> None:
        """Another arm stands in the own one's place with its own read-outs, `instead` in the cell's; None: back."""
        self.drive.cancel()
        self.seen = seen
        self.stage.make_room(instead)
        self.stage.view("whole")
        self.on_page()

    def close_views(self) -> None:
        """The screens let go of what they hold."""
        for view in self.views:
            view.close()
        self.views = []

    def around(self, job: Job) -> None:
        """Does a job of the worker; what fails is told and changes nothing."""
        try:
            with self._server.atomic():
                try:
                    job()
                except Exception as error:
                    self._tell(error)
        except Exception:
            _LOG.exception("the page of session %s could not be updated", self.session.name)

    def _make_stage(self) -> Stage:
        with self._server.atomic():  # one word to the pages instead of one for each part
            self._server.scene.world_axes.visible = False
            look, aids, dragged = self.look, self.aids, self.following.event
            stage = Stage(self._server, self.world, dragged, dark=look.dark, handle=aids.handle)
            stage.next_arm.look(self.open_screen)
            return stage

    def _own_world(self) -> World:
        """The cell of this arm, as the session has it."""
        state = self.session.state
        self._source = cell_key(state)
        return world_of(state) or cell_of(self._usual_world(self.model), state)

    def _moved(self, q: np.ndarray) -> None:
        self.stage.pose(q, self.world, self.hand())
        now = time.monotonic()
        if now - self._numbers_at >= _SHOWN:
            self._numbers_at = now
            self.worker.latest("numbers", self.numbers)  # after the scene, not before it
        elif not self.worker.waits("numbers"):
            self.worker.later("numbers", _SHOWN, self.numbers)
        self.on_page()

    def _handle_back(self) -> None:
        self.stage.hold(self.hand())

    def _tell(self, error: Exception) -> None:
        if isinstance(error, TeachframeError):
            level = "error" if isinstance(error, StorageError) else "warning"
            self.say(level, error_text(error, self.language))
        else:
            _LOG.error("a job failed", exc_info=error)
            words = one_line(f"{type(error).__name__}: {error}", 160)
            self.say("error", self.t("message.fault", what=words))
        for view in self.views:  # what was entered goes back to what is so
            view.refresh(self.session.state)
        self.on_page()
