"""Before a capture: what it would bring, and the best next touch as a ghost arm to go to."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from app.calibration.captures import Step, of_role
from app.calibration.checks.mixed_configuration import wrist_sides
from app.calibration.next_touch import Proposal, predicted_error, propose
from app.calibration.next_touch.prediction import USUAL_NOISE
from app.calibration.wording import Phrase
from app.errors import DegenerateGeometryError
from app.panel import markup as html
from app.screens._tool.hand import AXES
from app.screens._tool.strokes import strokes_free
from app.screens._tool.words import Words
from app.session import SessionState
from app.session.motion.guarding import hit
from app.simulation.route import short_of
from app.simulation.world import default_tool
from app.units import mm

if TYPE_CHECKING:
    from app.screens.context import Context

#: Modes whose tool point comes from fewer touches than this do not gain by the orientations of the touches.
_LEAST = 3
_WRIST = 3  # joints
_HERE = "{here}"
#: Held by whoever works one out: threads that reckon at once only take turns, and each turn keeps the stop waiting.
_ONE = threading.Lock()


class NextTouch:
    """A button, and a few lines that `explain` places; the ghost stands in the scene.

    Args:
        context: where it is shown.
        words: what the steps are called.
    """

    def __init__(self, context: Context, words: Words):
        self._context, self._words = context, words
        ui, t = context.ui, context.t
        self.go_button = ui.add_button(
            t("tool.propose"), hint=t("tool.propose_hint"), rank="plain", visible=False
        )
        context.clicked(self.go_button, self.go)
        self._asked: tuple[object, ...] = ()
        self._made = np.zeros((0, 3, 3))
        self._step: Step | None = None
        self.proposal: Proposal | None = None
        self.goal: np.ndarray | None = None  # where the key leads: the ghost, or short of it
        self._refused = ""
        self._closed, self._written = False, ""

    def explain(self) -> None:
        """What a touch would bring stands here: below the keys, which are pressed every time."""
        self._lines = self._context.ui.add_html("", visible=False)

    def refresh(self, state: SessionState) -> None:
        """Asks for the best next touch where the points, the mode or the arm changed."""
        step = state.missing[0] if state.missing and state.result is None else None
        helpful = step is not None and "touch" in step.roles and _least(state) >= _LEAST
        if not (helpful and self._context.aids.next_touch):
            self._put_away()
            return
        touches = of_role(state.ordered, "touch")
        asked = (state.robot, state.mode, state.touches, step, *touches, self._context.world)
        if len(asked) == len(self._asked) and all(
            a is b or a == b for a, b in zip(asked, self._asked, strict=True)
        ):
            return
        self._asked, self._step, self._written = asked, step, ""
        self._made = np.array([c.T_base_flange.rotation for c in touches]).reshape(-1, 3, 3)
        self.proposal, self.goal, self._refused = None, None, ""
        self._lines.visible = self.go_button.visible = self.go_button.disabled = True
        self._ask(state, asked)
        self.numbers()

    def numbers(self) -> None:
        """The arm moved: what a touch as it stands now would bring."""
        if self._step is not None:
            self._lines.content = self._table().replace(_HERE, self._here())

    def go(self) -> None:
        """The arm goes where the ghost stands."""
        context, proposal = self._context, self.proposal
        if proposal is None or proposal.q is None:
            return
        title = self._title()
        # The ghost holds the tool that is drawn: with the one that is there its tip may be within the spike.
        short = short_of(context.world, context.drive.guard, context.q, proposal.q)
        self.goal = proposal.q if short is None else short

        def arrived() -> None:
            if short is not None:
                context.say("info", context.t("message.proposed_short", title=title))
                return
            # Where no hand helps and the light says that the tip touches, it is recorded next.
            light, hand = context.aids.light, context.aids.touch
            key = "touched" if light and not hand and context.world.touching(context.q) else "proposed"
            context.say("info", context.t(f"message.{key}", title=title))

        context.go(self.goal, arrived, context.t("errand.ghost", title=title))

    def close(self) -> None:
        """The page goes away: what is still being worked out is not shown."""
        self._closed = True

    def _ask(self, state: SessionState, asked: tuple[object, ...]) -> None:
        context, made, q = self._context, self._made, np.array(self._context.q)
        robot, world, tool = context.model, context.world, default_tool(context.model).position
        axes = tuple(AXES[s.role] for s in state.missing if s.role in AXES)
        # An origin of its own is touched as the arm stands after the last touch: the strokes start there, too.
        starts_here = any("origin" in step.roles for step in state.missing[:2])

        side = _side(state)

        def hindered(q: np.ndarray) -> bool:
            return hit(world, q) is not None or (starts_here and not strokes_free(world, q, axes))

        def flipped(q: np.ndarray) -> bool:
            return float(wrist_sides(robot, q[None])[0]) == -side

        def best(collides: Callable[[np.ndarray], bool]) -> Proposal | DegenerateGeometryError:
            try:
                return propose(
                    made,
                    tool=tool,
                    spike=world.p_base_spike_drawn,
                    touches=state.touches,
                    reference=None if len(made) else robot.forward(robot.home).rotation,
                    robot=robot,
                    q_near=q,
                    collides=collides,
                )
            except DegenerateGeometryError as error:
                return error

        def work() -> Proposal | DegenerateGeometryError | None:
            """With the wrist as at the touches made, where that leaves something to propose; None where nobody asks
            for it any more: another point was recorded while it waited, or the page was made anew."""
            with _ONE:
                if gone():
                    return None
                found = best(lambda q: (bool(side) and flipped(q)) or hindered(q))
                return best(hindered) if side and isinstance(found, DegenerateGeometryError) else found

        def gone() -> bool:
            return self._closed or asked is not self._asked

        def done(found: Proposal | DegenerateGeometryError | None) -> None:
            if found is None or gone():
                return
            if isinstance(found, Proposal):
                self.proposal, self.goal = found, found.q
                context.stage.next_arm.show("tool", found.q, self._title())
            else:
                said = found.said
                self._refused = said.text(context.language) if isinstance(said, Phrase) else str(found)
                context.stage.next_arm.show("tool", None)
            self._written = ""
            self.go_button.disabled = self.proposal is None
            context.numbers()  # which key is next depends on it

        context.background(work, done)

    def _put_away(self) -> None:
        self._asked, self._step, self.proposal, self.goal = (), None, None, None
        self._lines.visible = self.go_button.visible = False
        self._context.stage.next_arm.show("tool", None)

    def _title(self) -> str:
        return self._words.step(self._step).title if self._step is not None else ""

    def _here(self) -> str:
        """What a touch as the arm stands now would bring."""
        here = np.concatenate([self._made, self._context.model.forward(self._context.q).rotation[None]])
        return self._length(predicted_error(here))

    def _table(self) -> str:
        """The lines, with a mark where what changes with every move stands: written once a proposal."""
        self._written = self._written or self._write()
        return self._written

    def _write(self) -> str:
        t, found = self._context.t, self.proposal
        if self._refused:
            return html.paragraph(self._refused, testid="next-touch")
        if found is None:
            return html.paragraph(t("tool.next_busy"), testid="next-touch", faint=True)
        rows = [
            (t("tool.next_now"), self._length(found.now)),
            (t("tool.next_here"), _HERE),
            (t("tool.next_best"), self._length(found.after)),
        ]
        if len(found.following):
            count = len(self._made) + 1 + len(found.following)
            rows.append((t("tool.next_end", count=count), self._length(found.at_end)))
        return (
            html.paragraph(t("tool.next_title", title=self._title()), strong=True)
            + html.table(rows, testid="next-touch")
            + html.paragraph(t("tool.next_noise", mm=f"{mm(USUAL_NOISE):.1f}"), faint=True)
        )

    def _length(self, value: float) -> str:
        return f"± {mm(value):.2f} mm" if np.isfinite(value) else self._context.t("tool.next_open")


def _side(state: SessionState) -> float:
    """Which way round the wrist is at most of the touches made: 1, -1, or 0 where that is not known."""
    qs = [c.q for c in of_role(state.ordered, "touch") if c.q is not None and len(c.q) >= _WRIST]
    if len(qs) == 0:
        return 0.0
    return float(np.sign(wrist_sides(state.model, np.array(qs)).sum()))


def _least(state: SessionState) -> int:
    from app.session.state import mode_named

    return mode_named(state.mode).least_touches
