"""The demonstration of a wizard mode: it plays by itself or step by step, beside the wizard whose buttons it presses.

A person's own points are put away meanwhile and stand there again when it ends, however it ends.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.calibration.captures import Demo, Step
from app.calibration.modes import modes
from app.panel import markup as html
from app.screens._tool.paper import calculate
from app.screens._tool.words import Words
from app.screens._training.demo_points import load_demo, reachable
from app.session import SessionState
from app.session.actions import Accept, Calculate, ChooseMode, ChooseRobot, Enter, Undo
from app.session.state import FIRST_ROBOT

if TYPE_CHECKING:
    import numpy as np

    from app.screens.context import Context

_REST = 2.6  # seconds a caption is left to be read
_PRESS = 1.0  # seconds the last button is seen pressed
_DIRECT = "direct"
_TIMER = "demonstration"


class Showing:
    """A choice of modes; while one plays, a strip with the caption of the step at hand.

    Args:
        context: where it plays.
    """

    def __init__(self, context: Context):
        self._context, self._words = context, Words(context)
        ui, t = context.ui, context.t
        self._folder = ui.add_folder(t("training.demo"))
        with self._folder:
            self._titles = {self._words.mode(mode): mode for mode in modes().values()}
            self._choice = ui.add_choice(t("tool.mode"), tuple(self._titles))
            start = ui.add_button(t("training.play"), hint=t("training.play_hint"), rank="plain")
            context.clicked(start, self._start)
        self.strip = ui.add_strip()
        with self.strip:
            self._caption = ui.add_html("")
            self._group = ui.add_buttons(t("training.demo"), ())
            context.chosen(self._group, self._pressed)
        self.playing = self._paused = False
        self._mine: SessionState | None = None  # what stands there again afterwards
        self._ways: list[np.ndarray] = []
        self._captions: list[Step] = []
        self._at = 0

    @property
    def visible(self) -> bool:
        return self._folder.visible

    @visible.setter
    def visible(self, value: bool) -> None:
        self._folder.visible = value

    @property
    def at(self) -> int:
        """Points that were shown."""
        return self._at

    # What somebody does ------------------------------------------------------------------------------------

    def _start(self) -> None:
        self.play(self._titles[str(self._choice.value)].key)

    def _pressed(self, label: str) -> None:
        t = self._context.t
        jobs = {
            t("training.demo_pause"): self.pause,
            t("training.demo_on"): self.go_on,
            t("training.demo_next"): self.step,
            t("training.stop"): self.stop,
        }
        jobs[label]()

    def pause(self) -> None:
        """The arm stops where it is; what was shown stays."""
        self._paused = True
        self._halt()
        self._offer()

    def go_on(self) -> None:
        """It plays by itself again."""
        self._paused = False
        self._offer()
        self._next()

    def step(self) -> None:
        """The next point alone, then it waits."""
        self._paused = True
        self._halt()
        self._offer()
        self._next()

    def stop(self) -> None:
        """Ends a demonstration where it is; the own points stand there again."""
        if self._mine is None:
            return
        self._halt()
        had = bool(self._mine.captures) or self._mine.result is not None
        self._ended()
        self._give_back()
        self._context.refresh()
        key = "training.demo_gave_back" if had else "training.demo_over"
        self._context.say("good", self._context.t(key))

    def close(self) -> None:
        """The page goes: nothing is shown any more, but what was put away comes back."""
        if self._mine is not None:
            self._halt()
            self._give_back()

    # How it plays ------------------------------------------------------------------------------------------

    def play(self, key: str) -> None:
        """Plays one mode: its points are loaded, the arm goes to each, the result is calculated."""
        context, mode = self._context, modes()[key]
        context.drive.must_not_be_stopped()
        context.drive.must_be_seen()
        self.stop()
        if context.session.state.robot != FIRST_ROBOT:
            if context.session.state.captures:
                context.say("warning", context.t("training.demo_other_arm"))
                return
            context.do(ChooseRobot(FIRST_ROBOT))  # makes the page anew: another Showing plays
            for showing in filter(None, (getattr(view, "showing", None) for view in context.views)):
                showing.play(key)
            return
        self._choice.value = self._words.mode(mode)
        self._mine = context.session.state
        demo, stops = reachable(context.model, mode)
        self.playing, self._paused, self._at, self._ways = True, False, 0, []
        self.strip.visible = True
        if not demo.captures:
            self._enter(demo)
            return
        known = demo.options.get("known_tool")
        if known is not None:
            self._know(tuple(float(v) for v in known))
        context.demonstrated = 0
        state = context.do(load_demo(mode, demo, context.t("training.demo")))
        self._captions = [self._words.step(step) for step in state.steps]
        q = context.q
        for stop in stops:  # a point out of this arm's reach is told, not shown
            q = q if stop is None else stop
            self._ways.append(q)
        self._offer()
        context.open("tool")
        self._next()

    def _next(self) -> None:
        """The arm goes to the next point; after the last one the result is calculated."""
        if not self.playing:
            return
        if self._at == len(self._ways):
            self._light("calculate")
            self._context.worker.later(_TIMER, _PRESS, self._finish)
            return
        number = self._at
        self._say(number)
        self._light("")
        self._context.drive.tour(
            [self._ways[number]],
            lambda arrived: self._there(number) if arrived < 0 else None,
            0.0,
            self._context.t("errand.demo"),
            checked=False,
        )

    def _there(self, number: int) -> None:
        """The arm stands at a point: its button is pressed, for all to see."""
        if not self.playing or number != self._at:
            return
        self._at = self._context.demonstrated = number + 1
        self._context.refresh()
        self._light(f"{self._captions[number].key}/record")
        if not self._paused:
            self._context.worker.later(_TIMER, _REST, self._next)

    def _finish(self) -> None:
        if not self.playing:
            return
        mode = modes()[self._context.session.state.mode]
        self._context.demonstrated = None
        calculate(self._context)
        self._light("")
        self.playing = False
        self._caption.content = html.instruction(
            self._words.mode(mode), self._context.t("training.demo_done")
        )
        self._offer()

    def _halt(self) -> None:
        self._context.worker.halt(_TIMER)
        self._context.drive.cancel()

    def _ended(self) -> None:
        self.playing = False
        self._context.demonstrated = None
        self.strip.visible = False
        self._light("")

    def _give_back(self) -> None:
        """The session as it was before, by undoing."""
        mine, self._mine = self._mine, None
        session = self._context.session
        while mine is not None and session.state.before is not None and not _same(session.state, mine):
            session.do(Undo())

    # What is shown -----------------------------------------------------------------------------------------

    def _offer(self) -> None:
        """The buttons that make sense now."""
        t = self._context.t
        if not self.playing:
            self._group.options = (t("training.stop"),)
            return
        first = (t("training.demo_on"),) if self._paused else (t("training.demo_pause"),)
        self._group.options = (t("training.demo_next"), *first, t("training.stop"))

    def _say(self, number: int) -> None:
        step, t = self._captions[number], self._context.t
        count = t("training.demo_step", number=number + 1, count=len(self._captions), title=step.title)
        press = t("training.demo_press", button=t("tool.record"))
        self._caption.content = html.instruction(count, f"{step.instruction} {press}")
        self._context.say("info", f"{count}: {step.instruction} {press}")

    def _light(self, pressed: str) -> None:
        """The button that an operator would press now looks pressed; empty lets all go."""
        for view in self._context.views:
            if hasattr(view, "show_pressed"):
                view.show_pressed(pressed)

    def _know(self, position: tuple[float, ...]) -> None:
        """The tool that is known: typed in and accepted, as an operator would."""
        self._typed(position, (0.0, 0.0, 0.0))
        self._context.do(Accept(self._context.t("training.known_tool")))

    def _enter(self, demo: Demo) -> None:
        """Direct entry has no points: its numbers are typed in."""
        options = demo.options
        self._typed(options["position"], options["angles"])
        words = self._context.t("training.demo_direct")
        self.playing = False
        self._offer()
        self._context.open("tool")
        self._caption.content = html.instruction(self._words.mode(modes()[_DIRECT]), words)
        self._context.say("info", words)

    def _typed(self, position, angles) -> None:
        self._context.do(ChooseMode(_DIRECT))
        x, y, z = (float(v) for v in position)
        self._context.do(Enter((x, y, z), tuple(float(v) for v in angles)))
        self._context.do(Calculate())


def _same(state: SessionState, mine: SessionState) -> bool:
    """True where all that a person had made stands there."""
    return (
        (state.mode, state.touches, state.entered) == (mine.mode, mine.touches, mine.entered)
        and dict(state.captures) == dict(mine.captures)
        and state.result is mine.result
        and state.tools == mine.tools
        and state.source == mine.source
    )
