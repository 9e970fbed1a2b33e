"""Where the arm of one session stands, and how it gets elsewhere: seen at once, written down when it rests."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import Any, Literal, Protocol

import numpy as np

from app.errors import ActionRefusedError
from app.geometry import Pose
from app.kinematics import IkResult, RobotModel, solve_ik
from app.kinematics.singular import singular_joints
from app.session.actions import Move
from app.session.motion.enabling import Enabling
from app.session.motion.guarding import guard_of, words
from app.session.motion.pace import duration, pause, tool_points, travel
from app.session.motion.trail import Trail
from app.session.motion.worker import Job, Worker
from app.session.session import Session
from app.session.state import as_tuple
from app.simulation.guard import Guard, Stop
from app.simulation.route import route
from app.simulation.world import World, default_tool

How = Literal["standing", "moving", "waiting", "measuring", "stopped"]
#: Motions that end when another begins, by the name the worker knows them by.
MOTIONS = ("move", "jog", "drag", "base", "replay")
_FLANGE = Pose.of(None, np.zeros(3))


class Voice(Protocol):
    """Tells the operator something in his language."""

    @property
    def language(self) -> str:
        """Of what is said."""
        ...

    seen: Callable[[], Any] | None  # an arm that is shown in this one's place; None for none

    def t(self, key: str, **fields: Any) -> str:
        """A text in the operator's language."""
        ...

    def say(self, level: str, words: str) -> None:
        """The message line, and the log."""
        ...


class Drive:
    """The arm's drive.

    Args:
        session: where it is written where the arm rests.
        world: the cell.
        worker: whose thread moves the arm.
        voice: tells what stopped it.
        shown: called with each pose (n,) the arm takes.
        rested: called when a motion has ended.
        clock: seconds that only grow.
    """

    def __init__(
        self,
        session: Session,
        world: World,
        worker: Worker,
        voice: Voice,
        shown: Callable[[np.ndarray], None],
        rested: Callable[[], None],
        clock: Callable[[], float] = time.monotonic,
    ):
        self.session, self.worker, self.voice, self.clock = session, worker, voice, clock
        self._shown, self.rested = shown, rested
        self.enabling, self.override = Enabling(clock), 0.5
        self.trail = Trail()
        self.world = world
        self.q = np.array(session.state.q)
        self._guard: Guard | None = None
        self.errand = ""  # what a motion that waits for the switch is for
        self.measuring = False  # what runs looks at what stands: no arm moves, and it needs no switch
        self.met: Stop | None = None  # what stopped the arm, until it moves on

    # What it is asked -------------------------------------------------------------------------------------

    @property
    def live(self) -> bool:
        """True while the arm may move."""
        return self.enabling.live

    @property
    def model(self) -> RobotModel:
        """The arm."""
        return self.world.robot

    @property
    def how(self) -> How:
        """`stopped`, `moving`, `waiting` for the switch, `measuring` without it, or `standing`."""
        if self.enabling.stopped:
            return "stopped"
        if self.moves:
            return "moving" if self.live else "waiting"
        return "measuring" if self._runs else "standing"

    @property
    def _runs(self) -> bool:
        return any(map(self.worker.running, MOTIONS))

    @property
    def moves(self) -> bool:
        """True while the arm moves, or waits for the switch to move."""
        return self._runs and not self.measuring

    @property
    def T_flange_tool(self) -> Pose:
        """The tool the controller reckons with: the active one, else the bare flange."""
        tool = self.session.state.tool
        return _FLANGE if tool is None else tool.T_flange_tool

    def hand(self, q: np.ndarray | None = None) -> Pose:
        """T_base_tool as the controller reckons it; q (n,), or where the arm stands."""
        return self.world.shown_flange(self.q if q is None else q) @ self.T_flange_tool

    @property
    def points(self) -> np.ndarray:
        """(3, 3) points in the flange that keep to the manual speed [m]."""
        return tool_points(self.T_flange_tool, default_tool(self.model))

    @property
    def guard(self) -> Guard:
        """What keeps this arm from hitting anything."""
        if self._guard is None or self._guard.world is not self.world:
            self._guard = guard_of(self.world)
        return self._guard

    def solve(self, target: Pose, start: np.ndarray | None = None) -> IkResult:
        """Joints that bring the tool the controller reckons with to `target`, T_base_tool."""
        return solve_ik(
            self.model, target, self.q if start is None else start, T_flange_tool=self.T_flange_tool
        )

    def why(self, result: IkResult) -> str:
        """Why the arm did not get further."""
        singular = result.reason == "singular"
        joints = singular_joints(self.model, result.q) if singular else result.joints
        return self.voice.t(f"message.{result.reason}", joints=", ".join(map(str, joints)))

    # What it does -----------------------------------------------------------------------------------------

    def must_not_be_stopped(self) -> None:
        """Raises ActionRefusedError while the emergency stop is latched."""
        if self.enabling.stopped:
            raise ActionRefusedError(self.voice.t("message.e_stop"))

    def must_be_seen(self) -> None:
        """Raises ActionRefusedError while another arm is shown in this one's place: nobody would see what moves."""
        if self.voice.seen is not None:
            raise ActionRefusedError(self.voice.t("message.other_arm"))

    def stop(self) -> None:
        """Emergency stop; may come from any thread, and does not wait in a queue."""
        self.enabling.stop()
        self.worker.halt()
        self.errand = ""

    def cancel(self) -> None:
        """Whatever moves, or waits to move, is given up where the arm stands."""
        for name in MOTIONS:
            self.worker.halt(name)
        self.errand = ""

    def go(self, q: np.ndarray, then: Job | None = None, errand: str = "") -> None:
        """The arm moves to q (n,) while the switch is held; `then` is done at the end."""
        self.tour([np.asarray(q, float)], lambda number: then() if then and number < 0 else None, 0.0, errand)

    def approach(self, q: np.ndarray, errand: str = "") -> None:
        """The arm goes straight to q (n,), within its limits, as far as nothing is hit: for typed values."""
        q = np.clip(q, self.model.lower, self.model.upper)
        self.tour([q], lambda _: None, 0.0, errand, checked=False, guarded=True)

    def tour(
        self,
        stops: list[np.ndarray],
        arrived: Callable[[int], object],
        rest: float = 0.5,
        errand: str = "",
        *,
        checked: bool = True,
        guarded: bool = False,
    ) -> None:
        """The arm goes through poses; `arrived` hears the number of each, and once more -1 at the end.

        Args:
            rest: seconds at each pose.
            errand: what it is for, told while the arm waits for the switch.
            checked: each way is looked at first, and gone round what is in it; where none is free the tour ends and
                the operator hears why. False goes straight: for poses somebody has been at.
            guarded: it stops before what it would hit.
        """
        self.must_not_be_stopped()
        self.must_be_seen()
        self.cancel()
        self.errand = errand
        self.worker.animate("move", self._travel(stops, arrived, rest, checked, guarded))
        self.rested()

    def advance(self, q: np.ndarray) -> Stop | None:
        """The arm goes straight to q (n,) at once, or to what is in its way, which is given back."""
        at, stop = self.guard.advance(self.q, q)
        if not self.live:  # let go of, or silent, while this was worked out
            return None
        self.show(at)
        self.met = stop
        return stop

    def show(self, q: np.ndarray) -> None:
        """The arm stands at q (n,)."""
        q = np.asarray(q, float)
        if not np.array_equal(q, self.q):
            self.met = None
        self.q = q
        if self.session.state.running is not None:
            self.trail.passing(self.q)
        self._shown(self.q)

    def settle(self) -> None:
        """Writes down where the arm stands, where that is not yet done."""
        if as_tuple(self.q) != self.session.state.q:
            self.session.do(Move(as_tuple(self.q), self.trail.take()))

    def rest(self) -> None:
        """A motion has ended: it is written down and, as a job of its own, told."""
        self.settle()
        self.worker.post(self.rested)

    def paced(
        self, start: np.ndarray, end: np.ndarray, show: Callable[[np.ndarray], object]
    ) -> Iterator[None]:
        """From start to end (n,) as this arm may move."""
        return travel(self, start, end, duration(self.model, start, end, self.points), show)

    def _travel(
        self,
        stops: list[np.ndarray],
        arrived: Callable[[int], object],
        rest: float,
        checked: bool,
        guarded: bool,
    ) -> Iterator[None]:
        for number, stop in enumerate(stops):
            way = route(self.world, self.guard, self.q, stop) if checked else [stop]
            if isinstance(way, Stop):
                self.met = way
                why = words(way, self.voice.t, self.voice.language)
                self._stopped(self.voice.t("message.no_way", why=why))
                return
            for leg in way:
                hit: list[Stop] = []
                yield from self.paced(self.q.copy(), leg, lambda q, hit=hit: self._step(q, guarded, hit))
                if hit:
                    self._stopped(words(hit[0], self.voice.t, self.voice.language))
                    return
            arrived(number)
            yield from pause(self, rest)
        self.rest()
        self.worker.post(lambda: self._done(arrived))

    def _step(self, q: np.ndarray, guarded: bool, hit: list[Stop]) -> Stop | None:
        if not guarded:
            if self.live:
                self.show(q)
            return None
        if hit:
            return hit[0]
        stop = self.advance(q)
        if stop is not None:
            hit.append(stop)
        return stop

    def _stopped(self, why: str) -> None:
        self.voice.say("warning", why)
        self.errand = ""
        self.rest()

    def _done(self, arrived: Callable[[int], object]) -> None:
        if not self.worker.running("move"):
            self.errand = ""
        arrived(-1)
