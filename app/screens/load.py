"""Load data: the lesson in which a payload is found by moving the arm, four poses and a run."""

from __future__ import annotations

import tempfile
import threading
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from app.apart import SEARCH, GivenUpError, apart
from app.errors import ActionRefusedError
from app.panel import Row
from app.panel import markup as html
from app.session import SessionState
from app.session.actions import HangLoad, WeighAt, Weighed
from app.session.state import Weighing, as_tuple
from app.session.steps.load import POSES
from app.training.weighing import (
    APART,
    LoadData,
    hidden_load,
    least_turn,
    off,
    proposed,
    weigh,
)
from app.units import deg, mm

if TYPE_CHECKING:
    from app.screens.context import Context

_SEEDS = 1_000_000
MASS, CENTRE = 0.05, 0.01  # share and m: within these the load data are as good as makers ask for
_REST = 0.4  # s at each pose of the run that is seen


class _View:
    """The run, what it found, and four rows: what was found stands above them, as what is read.

    Args:
        context: where it stands.
    """

    def __init__(self, context: Context):
        self._context = context
        self._load: Weighing | None = context.session.state.load
        self._stop = threading.Event()
        ui, t = context.ui, context.t
        ui.add_html(html.paragraph(t("load.intro"), testid="load-intro"))
        self._next = ui.add_html("")
        self._go = ui.add_button(t("load.go"), rank="plain", hint=t("load.go_hint"))
        context.clicked(self._go, self._propose)
        self._record = ui.add_button(t("load.record"))
        context.clicked(self._record, self._take)
        self._run = ui.add_button(t("load.run"), visible=False)
        context.clicked(self._run, self._move)
        self._bar = ui.add_progress(visible=False)
        self._result = ui.add_html("", visible=False)
        self._reveal = ui.add_button(t("load.reveal"), rank="plain", visible=False)
        context.clicked(self._reveal, self._show_truth)
        self._truth = ui.add_html("", visible=False)
        self._rows = ui.add_rows()
        context.chosen(self._rows, self._in_row)
        self._again = ui.add_button(t("load.again"), rank="quiet", visible=False)
        context.clicked(self._again, self._anew)
        self._show()

    @property
    def found(self) -> LoadData | None:
        """What was found."""
        said = self._load.found if self._load is not None else None
        return said and LoadData(said.mass, said.centre, said.mass_half, said.centre_half)

    @property
    def true(self) -> LoadData | None:
        """What hangs there; None while nothing does."""
        return hidden_load(self._context.model, self._load.seed) if self._load is not None else None

    # What somebody does ------------------------------------------------------------------------------------

    def _missing(self) -> list[int]:
        return [number for number in range(POSES) if number not in self._poses]

    @property
    def _poses(self) -> dict[int, np.ndarray]:
        load = self._load
        return {number: np.array(q) for number, q in load.poses.items()} if load is not None else {}

    def _propose(self) -> None:
        """The arm goes to the pose that is proposed for the next row."""
        missing, context = self._missing(), self._context
        if missing:
            title = context.t("load.pose", number=missing[0] + 1)
            context.go(
                proposed(context.model)[missing[0]],
                lambda: context.say("info", context.t("message.went", title=title)),
                context.t("errand.go", title=title),
            )

    def _take(self) -> None:
        missing = self._missing()
        if missing:
            self._keep(missing[0])

    def _in_row(self, pressed: str) -> None:
        key, _, action = pressed.partition("/")
        number = int(key.removeprefix("pose"))
        if action == "record":
            self._keep(number)
        elif number in self._poses:
            self._context.do(WeighAt(number))

    def _keep(self, number: int) -> None:
        """Records a pose; one like another would see gravity from the same side."""
        context, t = self._context, self._context.t
        if context.drive.how == "moving":
            raise ActionRefusedError(t("refused.moving"))
        turn = self._turned(number)
        if turn < APART:
            raise ActionRefusedError(
                t("load.alike", deg=f"{float(deg(turn)):.0f}", aim=f"{float(deg(APART)):.0f}")
            )
        if self._load is None:
            context.do(HangLoad(int(context.rng.integers(_SEEDS))))
        context.do(WeighAt(number, as_tuple(context.q)))
        context.say("good", t("load.recorded", number=number + 1))

    def _turned(self, number: int) -> float:
        """How far the flange is turned from every pose but this one, at the least [rad]."""
        model, q = self._context.model, self._context.q
        others = [pose for other, pose in self._poses.items() if other != number]
        return min((least_turn(model, np.array([pose, q])) for pose in others), default=np.pi)

    def _move(self) -> None:
        """The run: the arm goes through the poses, then what its drives felt is searched."""
        if self._missing():
            return
        context = self._context
        stops = [self._poses[number] for number in range(POSES)]
        context.drive.tour(
            stops, lambda number: self._weigh() if number < 0 else None, _REST, context.t("load.errand")
        )

    def _weigh(self) -> None:
        context, stop, load = self._context, threading.Event(), self._load
        if load is None or self._missing():
            return
        self._stop.set()
        self._stop = stop
        poses = np.array([load.poses[number] for number in range(POSES)])
        self._bar.visible, self._bar.value, self._run.visible = True, 0.0, False
        context.say("info", context.t("load.weighing"))

        def say(share: float, _: str) -> None:
            context.worker.latest("load.bar", lambda: setattr(self._bar, "value", 100.0 * share))

        def work() -> LoadData | Exception | None:
            with tempfile.TemporaryDirectory() as folder:
                asked = (context.model.address, poses, load.seed, Path(folder))
                try:
                    return apart(weigh, *asked, bounds=SEARCH, say=say, stop=stop)
                except Exception as error:
                    return error

        context.background(work, lambda found: self._weighed(stop, load, found))

    def _weighed(self, stop: threading.Event, load: Weighing, found: LoadData | Exception | None) -> None:
        if stop is not self._stop or load is not self._load or isinstance(found, GivenUpError):
            return
        self._bar.visible = False
        if isinstance(found, Exception):
            self._show()
            raise found
        if found is None:
            self._show()
            self._context.say("warning", self._context.t("load.none"))
        else:
            self._context.do(Weighed(found.mass, found.centre, found.mass_half, found.centre_half))
            self._context.say("good", self._context.t("load.done", kg=f"{found.mass:.3f}"))

    def _anew(self) -> None:
        self._stop.set()
        self._bar.visible = False
        self._context.do(HangLoad(int(self._context.rng.integers(_SEEDS))))

    # What is shown -----------------------------------------------------------------------------------------

    def _show(self) -> None:
        t, missing, found = self._context.t, self._missing(), self.found
        able = self._context.model.has_inertials
        self._go.visible = self._record.visible = able and bool(missing)
        self._run.visible = able and not missing and found is None
        self._again.visible = bool(self._poses)
        self._rows.rows = tuple(self._row(number) for number in range(POSES)) if able else ()
        if not able:
            words = t("load.no_masses")
        elif missing:
            words = t("load.next", number=missing[0] + 1)
        else:
            words = t("load.ready") if found is None else t("load.read")
        self._next.content = html.paragraph(words, strong=True, testid="load-next")
        ghost = proposed(self._context.model)[missing[0]] if able and missing else None
        title = t("load.pose", number=missing[0] + 1) if missing else ""
        self._context.stage.next_arm.show("load", ghost, title)
        self._result.visible = self._reveal.visible = found is not None
        self._truth.visible = False
        if found is not None:
            self._result.content = self._card(found)

    def _row(self, number: int) -> Row:
        t, done = self._context.t, number in self._poses
        first = next(iter(self._missing()), -1)
        actions = [("record", t("tool.re_record" if done else "tool.record"))]
        actions += [("delete", t("tool.delete"))] if done else []
        return Row(
            key=f"pose{number}",
            title=t("load.pose", number=number + 1),
            state="done" if done else "now" if number == first else "open",
            light="green" if done else "",
            note=t("tool.row_recorded" if done else "tool.row_open"),
            actions=tuple(actions),
        )

    def _card(self, found: LoadData) -> str:
        rows = [(self._context.t("load.mass"), f"{found.mass:.3f} kg", f"± {found.mass_half:.3f}")]
        for axis, value, half in zip("XYZ", found.centre, found.centre_half, strict=True):
            rows.append(
                (self._context.t("load.centre", axis=axis), f"{mm(value):.1f} mm", f"± {mm(half):.1f}")
            )
        return html.table(rows, head=(self._context.t("load.data"), "", "95%"), testid="load-result")

    def _show_truth(self) -> None:
        t, found, true = self._context.t, self.found, self.true
        if found is None or true is None:
            return
        share, apart_ = off(found, true)
        good = share <= MASS and apart_ <= CENTRE
        centre = ", ".join(f"{mm(v):.1f}" for v in true.centre)
        words = t("load.truth", kg=f"{true.mass:.3f}", centre=centre)
        verdict = t("load.good" if good else "load.bad", share=f"{100 * share:.1f}", mm=f"{mm(apart_):.1f}")
        light = html.light("green" if good else "red", verdict, testid="load-verdict")
        self._truth.content = light + html.paragraph(words, testid="load-truth")
        self._truth.visible = True

    def refresh(self, state: SessionState) -> None:
        """What was recorded or found changed."""
        if state.load is not self._load:
            self._load = state.load
            self._show()

    def numbers(self) -> None:
        """The arm moved: the key that is pressed next stands out."""
        if self._record.visible:
            fit = self._turned(self._missing()[0]) >= APART
            self._go.rank, self._record.rank = ("plain", "main") if fit else ("main", "plain")

    def close(self) -> None:
        """The page goes: what is searched is given up."""
        self._stop.set()


class _Load:
    key, order = "load", 50

    def build(self, context: Context) -> _View:
        """Makes the widgets."""
        return _View(context)


SCREEN = _Load()
