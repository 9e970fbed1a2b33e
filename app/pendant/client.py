"""One browser's view of one session: what is drawn, and the worker everything runs on."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import viser

from app.errors import TeachframeError, one_line
from app.geometry import Pose
from app.kinematics import IkResult, RobotModel, solve_ik
from app.kinematics.singular import singular_joints
from app.pendant.aids import Aids
from app.pendant.dragging import Dragging
from app.pendant.exercising import aids_of, cell_key
from app.pendant.jogging import Jogging
from app.pendant.layout import Layout
from app.pendant.loaded import cell_of
from app.pendant.look import LOOK, Look
from app.pendant.moving import Moving
from app.pendant.page import Page
from app.pendant.shelf import Shelf
from app.pendant.stage import Stage
from app.pendant.texts import error_text, text
from app.pendant.trail import Trail
from app.pendant.worker import Job, Worker
from app.session import AnyAction, Session, SessionState
from app.session.state import as_tuple, robot_named
from app.simulation.world import World
from app.training.cell import world_of

_LOG = logging.getLogger(__name__)
_LOG_LENGTH = 200
_LET_GO = 5.0  # seconds another tab waits for this one


class Pendant(Moving):
    """What a browser sees of a session.

    Args:
        client: viser's handle of the browser.
        session: whose state is shown.
        world_of: the cell of an arm.
        shelf: all sessions of the server.
        look: how the page shall look and speak.
    """

    def __init__(
        self,
        client: viser.ClientHandle,
        session: Session,
        world_of: Callable[[RobotModel], World],
        shelf: Shelf,
        look: Look | None = None,
    ):
        self.client, self.session, self._world_of, self.shelf = client, session, world_of, shelf
        look = look or Look()
        self.language, self.vocabulary = look.language, look.vocabulary
        self.dark, self.convention = look.dark, look.convention
        self.aids = aids_of(session.state)
        self.log: list[tuple[float, str, str]] = []
        self.open = True
        self._ending, self._given = threading.Lock(), threading.Event()
        self.trail, self.trainee, self.exercise = Trail(), "", ""
        self.dragging, self.jogging = Dragging(self), Jogging(self)
        self.q = np.array(session.state.q)
        self.world = self._own_world()
        self.rng = np.random.default_rng(abs(hash(session.name)) if session.name else 0)
        self.worker = Worker(f"pendant-{client.client_id}", self._around)
        self.post(self._build)

    # What screens use ------------------------------------------------------------------------------------

    @property
    def model(self) -> RobotModel:
        """The arm that is shown."""
        return robot_named(self.session.state.robot)

    def t(self, key: str, **fields: Any) -> str:
        """A text in the operator's language."""
        return text(key, self.language, **fields)

    def allow(self, aids: Aids) -> None:
        """Gives these aids and no others; the page is made anew (worker thread only)."""
        if aids != self.aids:
            self.aids = aids
            self.rebuild()

    def say(self, level: str, words: str) -> None:
        """The message line, and the log."""
        self.log.append((time.time(), level, words))
        del self.log[:-_LOG_LENGTH]
        self.layout.message(level, words)

    def do(self, action: AnyAction) -> SessionState:
        """An action on the session; every screen is refreshed. Raises ActionRefusedError, which `say`s itself."""
        self.settle()
        before = self.session.state
        state = self.session.do(action)
        if state.robot != before.robot or (state.running is None) != (before.running is None):
            self.q, self.aids = np.array(state.q), aids_of(state)
            self.world = self._own_world()
            self.rebuild()
        else:
            self.refresh()
        return state

    # What is shown ---------------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Shows the session's state everywhere."""
        state = self.session.state
        if as_tuple(self.q) != state.q:
            self.show(np.array(state.q))
        else:
            self.stage.handle.place(self.hand())  # another tool may have been accepted
        if any(a is not b for a, b in zip(cell_key(state), self._source, strict=True)):
            self.world = self._own_world()
            self.stage.cell(self.world)
        self.stage.refresh(state)
        self.page.refresh(state)

    def _own_world(self) -> World:
        """The cell of this arm, as the session has it."""
        state = self.session.state
        self._source = cell_key(state)
        exercise = world_of(state)
        if exercise is not None:
            return exercise
        return cell_of(self._world_of(self.model), state)

    @property
    def look(self) -> Look:
        """How the page looks and speaks."""
        return Look(self.language, self.vocabulary, self.convention, self.dark)

    def keep_look(self) -> None:
        """The browser remembers how the page looks and speaks."""
        self.client.local_storage.set_item(LOOK, self.look.written())

    def rebuild(self) -> None:
        """Makes the whole page anew: another arm, another language."""
        self.keep_look()
        self.worker.halt()
        self.page.close()
        self.client.gui.reset()
        self.client.scene.reset()
        self._build()
        if self.log:
            self.layout.message(*self.log[-1][1:])

    def solve(self, target: Pose, start: np.ndarray | None = None) -> IkResult:
        """Joints that bring the tool the controller reckons with to `target`, T_base_tool."""
        return solve_ik(
            self.model,
            target,
            self.q if start is None else start,
            T_flange_tool=self.T_flange_tool,
        )

    def why(self, result: IkResult) -> str:
        """Why the arm did not get further."""
        singular = result.reason == "singular"
        joints = singular_joints(self.model, result.q) if singular else result.joints
        return self.t(f"message.{result.reason}", joints=", ".join(map(str, joints)))

    # The life of the view --------------------------------------------------------------------------------

    def greet(self, how: str) -> None:
        """Says how the session was found: "new", "back" or "lost"."""

        def job() -> None:
            recorded = len(self.session.state.captures)
            if how == "lost":
                self.say("warning", self.t("message.lost"))
            elif how == "back" and recorded:
                self.say("good", self.t("message.back", points=recorded))
            else:
                self.say("info", self.t("message.welcome"))

        self.post(job)

    def taken_over(self) -> None:
        """Another tab will show this session: on return this one has let go, its arm written."""
        self.worker.halt()
        self.post(self._let_go)
        self._given.wait(_LET_GO)

    def close(self) -> None:
        """The browser is gone, or the server stops, or both: where the arm stands is written, the worker ends, screens
        let go. Where the session was given to another tab, nothing is written: the arm is that tab's."""
        self.open = False
        with self._ending:
            self.worker.stop()
            if self._given.is_set():
                return
            try:
                if not self.session.closed:
                    self.settle()
            except TeachframeError as error:
                _LOG.warning("where the arm stands was not kept: %s", error)
            finally:
                self._given.set()
            if hasattr(self, "page"):
                self.page.close()
                self.stage.handle.remove()  # a drag that goes on has nothing to move any more

    def _build(self) -> None:
        self.layout = Layout(self.client.gui, dark=self.dark)
        self.stage = Stage(
            self.client, self.world, self.dragging.event, dark=self.dark, handle=self.aids.handle
        )
        self.page = Page(self)
        self.show(self.q)
        self.refresh()

    def _let_go(self) -> None:
        self.settle()
        self.page.close()
        self.client.gui.reset()
        self.client.scene.reset()
        self.open = False
        self.layout = Layout(self.client.gui, dark=self.dark)
        self.client.gui.add_markdown(f"**{self.t('message.taken')}**\n\n{self.t('message.taken_detail')}")
        self.layout.message("warning", self.t("message.taken"))
        self._given.set()
        self.worker.stop()  # whatever still comes in is for nobody

    def _around(self, job: Job) -> None:
        """Does a job; what fails is told and changes nothing."""
        try:
            with self.client.atomic():
                try:
                    job()
                except Exception as error:
                    if self.open:  # else there is nobody to tell, nor a page to show what is so
                        self._tell(error)
        except Exception:
            if self.open:
                _LOG.exception("the page of session %s could not be updated", self.session.name)

    def _tell(self, error: Exception) -> None:
        if isinstance(error, TeachframeError):
            self.say("warning", error_text(error, self.language))
        else:
            _LOG.error("a job failed", exc_info=error)
            words = one_line(f"{type(error).__name__}: {error}", 160)
            self.say("error", self.t("message.fault", what=words))
        self.page.refresh(self.session.state)  # what was entered goes back to what is so
