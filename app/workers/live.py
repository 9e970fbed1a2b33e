"""One open session: what a page may ask of it, and what it is told. Everything here may be called from any thread."""

from __future__ import annotations

import logging
import secrets
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from app.calibration.vocabularies import vocabularies
from app.classroom.hints import Hints
from app.errors import TeachframeError
from app.kinematics import RobotModel
from app.scene.camera import CLOSE_UPS, VIEWS
from app.scene.client_page import client_page
from app.scene.pages import Frames
from app.scene.seen import window_size
from app.scene.server import PROTOCOL, SceneServer
from app.screens import screens
from app.screens.context import Context
from app.screens.look import Look
from app.screens.shelf import Shelf
from app.session import Session
from app.session.motion.jogging import FRAMES, INCREMENTS, Jog
from app.simulation.world import World
from app.texts import TEXTS, languages
from app.units import from_deg, from_mm
from app.workers.hinted import Hinted
from app.workers.readout import Read, read

_LOG = logging.getLogger(__name__)
_HANDLES = {"both": (True, True), "shift": (True, False), "turn": (False, True)}
_MOST_DOWNLOADS = 8  # files that wait to be fetched
#: Families of texts the page's own script shows.
_PAGE_TEXTS = ("page.", "jog.", "status.", "move.", "people.account")


@dataclass(frozen=True)
class Download:
    """A file for the person: fetched once, under a name nobody guesses."""

    token: str
    name: str
    content: bytes


class Live:
    """A session that is open.

    Args:
        session: whose.
        shelf: all sessions of its owner.
        usual_world: the cell of an arm.
        look: how the page looks and speaks.
        hints: where a trainer's words to its owner are kept; None on a server without classes.
    """

    def __init__(
        self,
        session: Session,
        shelf: Shelf,
        usual_world: Callable[[RobotModel], World],
        look: Look,
        hints: Hints | None = None,
    ):
        self.session = session
        self._server = SceneServer()
        self._listeners: set[Callable[[], None]] = set()
        self._lock = threading.Lock()
        self._downloads: dict[str, Download] = {}
        self.closed = False
        self.hints = Hinted(hints, self._news)
        #: True where it goes on in another process: its page here is told so and does not come back by itself.
        self.taken = False
        self.context = Context(session, self._server, shelf, usual_world, look, _build, self._give)
        self.context.on_page = self._news
        self.context.ui.news = self._news
        self.context.post(self.context.build)

    # The scene --------------------------------------------------------------------------------------------

    #: What a page of the scene has to say it speaks.
    scene_protocol = PROTOCOL

    async def show(self, page: Frames) -> None:
        """Shows the scene to a page until either ends; raises what the page's socket raises."""
        await self._server.show(page)

    @staticmethod
    def scene_page() -> bytes:
        """The scene's client."""
        return client_page()

    # What the page is told --------------------------------------------------------------------------------

    def listen(self, listener: Callable[[], None]) -> Callable[[], None]:
        """`listener` is called, on any thread, when something has changed; calling what is returned ends it."""
        with self._lock:
            self._listeners.add(listener)
        return lambda: self._listeners.discard(listener)

    def read(self) -> Read:
        """The frame's figures."""
        return read(self.context, self.hints)

    def texts(self) -> dict[str, str]:
        """What the page's own script says, in the operator's language."""
        language = self.context.language
        keys = [key for key in TEXTS.languages["en"] if key.startswith(_PAGE_TEXTS)]
        return {key: TEXTS.text(key, language) for key in keys}

    def choices(self) -> dict[str, Any]:
        """What can be chosen on the frame, and what is."""
        context = self.context
        return {
            "languages": languages(),
            "language": context.language,
            "dark": context.look.dark,
            "frames": list(FRAMES),
            "increments": list(INCREMENTS),
            "views": [name for name in VIEWS if context.aids.closeup or name not in CLOSE_UPS],
            "makers": list(vocabularies()),
            "look": context.look.written(),
        }

    def downloads(self) -> list[Download]:
        """Files that wait to be fetched."""
        with self._lock:
            return list(self._downloads.values())

    def fetch(self, token: str) -> Download | None:
        """A file, once."""
        with self._lock:
            return self._downloads.pop(token, None)

    # What the page asks -----------------------------------------------------------------------------------

    def beat(self, enabled: bool, axis: int | None, sign: int, press: int) -> None:
        """Which of enabling switch and motion button is held; see Jogging.beat."""
        context = self.context
        jog = None
        if axis is not None and sign in (-1, 1) and context.seen is None:
            count = context.model.joint_count if context.jogging.frame == "joint" else 6
            if 0 <= axis < count:
                jog = Jog(context.jogging.frame, axis, sign)
        context.jogging.beat(enabled, jog, press)

    def let_go(self) -> None:
        """The page is gone: the arm stands."""
        self.context.jogging.let_go()
        self.context.post(self.context.drive.settle)

    def stop(self) -> None:
        """Emergency stop."""
        self.context.drive.stop()
        self.context.post(self._stopped)

    def release(self) -> None:
        """Releases the emergency stop."""
        context = self.context
        context.drive.enabling.release()
        context.post(lambda: context.say("info", context.t("message.e_released")))

    def cancel(self) -> None:
        """Gives up what moves or waits to move."""
        context = self.context
        context.post(lambda: (context.drive.cancel(), context.drive.settle(), context.numbers()))

    def choose(self, what: str, value: Any) -> bool:
        """Something of the frame; False where it is not there or cannot be that."""
        context = self.context
        if what == "frame" and value in FRAMES:
            context.post(lambda: (setattr(context.jogging, "frame", value), context.numbers()))
        elif what == "increment" and value in INCREMENTS:
            context.jogging.increment = value
        elif what == "override" and isinstance(value, int | float) and 1 <= value <= 100:
            context.drive.override = float(value) / 100.0
        elif what == "language" and value in languages():
            context.post(lambda: self._speak(value))
        elif what == "dark" and isinstance(value, bool):
            context.post(lambda: self._darken(value))
        elif what == "view" and value in self.choices()["views"]:
            context.post(lambda: context.stage.view(str(value)))
        elif what == "window" and (size := window_size(value)) is not None:
            context.post(lambda: context.stage.window(size))
        elif what == "handle" and value in _HANDLES:
            shift, turn = _HANDLES[value]
            context.post(lambda: context.stage.want_handle(shift=shift, turn=turn))
        elif what == "screen" and value in [screen.key for screen in screens()]:
            context.wanted_screen = ""
            context.post(lambda: context.opened(str(value)))
        else:
            return False
        self._news()
        return True

    def home(self) -> None:
        """The arm goes home, while the switch is held."""
        context = self.context

        def job() -> None:
            if context.seen is not None:  # another arm stands in its place
                return
            said = context.t("message.home")
            context.go(context.model.home, lambda: context.say("info", said), context.t("move.home"))

        context.post(job)

    def joint(self, axis: int, value: float) -> None:
        """One joint goes to a typed value, in degrees or millimetres, while the switch is held."""
        context = self.context

        def job() -> None:
            if context.seen is not None or not 0 <= axis < context.model.joint_count:
                return
            q = context.q.copy()
            q[axis] = from_mm(value) if context.model.joints[axis].prismatic else from_deg(value)
            context.drive.approach(q, context.t("errand.joint", number=axis + 1))

        context.post(job)

    # Its life ---------------------------------------------------------------------------------------------

    def greet(self, how: str) -> None:
        """Says how the session was found: "new", "back" or "lost"."""
        context = self.context

        def job() -> None:
            recorded = len(context.session.state.captures)
            if how == "lost":
                context.say("warning", context.t("message.lost"))
            elif how == "back" and recorded:
                context.say("good", context.t("message.back", points=recorded))
            else:
                context.say("info", context.t("message.welcome"))

        context.post(job)

    def close(self) -> None:
        """Where the arm stands is written; everything ends."""
        self.closed = True
        context = self.context
        context.jogging.let_go()
        context.worker.stop()
        try:
            if not self.session.closed:
                context.drive.settle()
        except TeachframeError as error:
            _LOG.warning("where the arm stands was not kept: %s", error)
        context.close_views()
        self.session.close()
        self._server.stop()
        self._news()

    def _speak(self, language: str) -> None:
        context = self.context
        context.look = replace(context.look, language=language)
        context.log[:] = context.spoken.lines(context.log, language)
        context.rebuild()
        context.say("info", context.t("message.language"))

    def _darken(self, dark: bool) -> None:
        context = self.context
        context.look = replace(context.look, dark=dark)
        context.stage.floor(dark)
        context.on_page()

    def _stopped(self) -> None:
        context = self.context
        context.say("error", context.t("message.e_stop"))
        context.drive.settle()
        context.numbers()

    def _give(self, name: str, content: bytes) -> None:
        download = Download(secrets.token_urlsafe(16), name, content)
        with self._lock:
            self._downloads[download.token] = download
            while len(self._downloads) > _MOST_DOWNLOADS:
                self._downloads.pop(next(iter(self._downloads)))
        self._news()

    def _news(self) -> None:
        for listener in tuple(self._listeners):
            listener()


def _build(context: Context) -> list[Any]:
    """All screens; where one cannot be made, the others still can."""
    views: list[Any] = []
    for screen in screens():
        with context.ui.add_screen(screen.key, context.t(f"{screen.key}.title")):
            try:
                views.append(screen.build(context))
            except Exception as error:
                _LOG.exception("the screen %s could not be made", screen.key)
                what = f"{screen.key}: {type(error).__name__}: {error}"
                context.say("error", context.t("message.fault", what=what[:160]))
    return views
