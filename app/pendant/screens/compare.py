"""Compare: a recording beside the simulation; find what the simulation leaves out, and put it in."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from app.diagnosis.report.curves import driver_curves
from app.diagnosis.result import Diagnosis
from app.pendant.screens._compare import cards, plots
from app.pendant.screens._compare.drawing import Drawing, look_at
from app.pendant.screens._compare.finding import Search
from app.pendant.screens._compare.giving import send_model, send_report
from app.pendant.screens._compare.kept import kept_for
from app.pendant.screens._compare.loaded import Loaded
from app.pendant.screens._compare.sources import Sources
from app.session import SessionState

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_FACTORS = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1_000, 2_000, 5_000)
_MORPH_S = 1.2  # how long the arrows take to shrink
_PLAY_S = (4.0, 20.0)  # a log is played in real time within these bounds
_TRACE_S = 0.4  # seconds between two pictures of a trace while it plays


class _View:
    def __init__(self, pendant: Pendant):
        self._pendant, self._kept = pendant, kept_for(pendant.session.name)
        self._drawing: Drawing | None = None
        self._share, self._index, self._traced = 0.0, 0, 0.0
        gui, t = pendant.client.gui, pendant.t
        self._intro = gui.add_html(cards.html.paragraph(t("compare.intro"), testid="compare-intro"))
        self._source_folder = gui.add_folder(t("compare.source"))
        with self._source_folder:
            Sources(pendant, self._kept, self._arrived)
        self._about = gui.add_html("", visible=False)
        self._row = gui.add_slider(t("compare.row"), 1, 2, 1, 1, visible=False)
        pendant.changed(self._row, "compare.row", self._slide)
        self._row_text = gui.add_html("", visible=False)
        self._play = gui.add_button(t("compare.play"), visible=False, color="gray")
        pendant.clicked(self._play, self._start_play)
        self._search = Search(pendant, lambda: self._kept.loaded, self._found)
        self._verdict = gui.add_html("", visible=False)
        self._apply = gui.add_button(t("compare.apply"), visible=False, hint=t("compare.apply_hint"))
        pendant.clicked(self._apply, self._put_in)
        self._bars = gui.add_html("", visible=False)
        self._plot_folder = gui.add_folder(t("compare.plots"), visible=False)
        with self._plot_folder:
            self._driver: Any = gui.add_dropdown(t("compare.against"), ("-",))
            pendant.changed(self._driver, "compare.driver", lambda _: self._plot())
            self._plot_html = gui.add_html("")
        self._findings = gui.add_html("", visible=False)
        self._next = gui.add_checkbox(t("compare.next"), False, visible=False, hint=t("compare.next_hint"))
        pendant.changed(self._next, "compare.next", lambda on: self._show_next(on))
        self._looks = gui.add_folder(t("compare.looks"), visible=False, expand_by_default=False)
        with self._looks:
            self._factor = gui.add_dropdown(t("compare.factor"), tuple(f"× {f}" for f in _FACTORS))
            pendant.changed(self._factor, "compare.factor", lambda _: self._draw())
            self._arrows = gui.add_checkbox(t("compare.arrows"), True)
            pendant.changed(self._arrows, "compare.arrows", lambda _: self._draw())
        self._give_folder = gui.add_folder(t("compare.give"), visible=False)
        with self._give_folder:
            pendant.clicked(
                gui.add_button(t("compare.report")), lambda: send_report(pendant, self._kept.loaded)
            )
            self._model = gui.add_button(t("compare.model"), color="gray")
            pendant.clicked(self._model, lambda: send_model(pendant, self._kept.loaded))
            self._reveal = gui.add_button(t("compare.reveal"), color="gray", visible=False)
            pendant.clicked(self._reveal, self._show_truth)
            self._truth = gui.add_html("")
        self._close = gui.add_button(t("compare.close"), visible=False, color="gray")
        pendant.clicked(self._close, self._leave)
        if self._kept.loaded is not None:
            loaded = self._kept.loaded
            pendant.post(lambda: self._arrived(loaded))

    # What arrives ----------------------------------------------------------------------------------------

    def _arrived(self, loaded: Loaded) -> None:
        """A recording is there: the trainee's own arm makes room for it."""
        self._search.stop()
        self._clear()
        self._kept.loaded = loaded
        self._pendant.stage.make_room(True)
        self._drawing = Drawing(self._pendant.client.scene, loaded)
        factor = min(_FACTORS, key=lambda f: abs(f - loaded.factor))
        self._factor.value = f"× {factor}"
        self._index, self._share = loaded.worst, 1.0 if loaded.applied else 0.0
        look_at(self._pendant.client.camera, loaded)
        self._show(loaded)
        self._pendant.say(
            "info", self._pendant.t("compare.loaded", file=loaded.path.name, count=loaded.count)
        )

    def _found(self, loaded: Loaded, diagnosis: Diagnosis) -> None:
        if self._kept.loaded is not loaded:
            return  # another recording was loaded meanwhile
        place = self._index / max(loaded.count - 1, 1)
        loaded = self._kept.loaded = loaded.with_diagnosis(diagnosis)
        self._index, self._share = round(place * (loaded.count - 1)), 0.0
        if self._drawing is not None:
            self._drawing.update(loaded)
        self._show(loaded)
        level = {"clean": "good", "named": "good", "partly": "warning", "unexplained": "warning"}
        self._pendant.say(level[diagnosis.verdict], cards.verdict_sentence(diagnosis))

    def _show(self, loaded: Loaded) -> None:
        """Every widget by what is known of the recording."""
        pendant, found = self._pendant, loaded.diagnosis
        self._intro.visible = self._source_folder.visible = False
        self._about.content = cards.recording(pendant, loaded)
        self._row.max = loaded.count
        self._row.value = self._index + 1
        self._about.visible = self._row.visible = self._row_text.visible = True
        self._close.visible = self._plot_folder.visible = True
        self._play.visible = loaded.moving
        self._looks.visible = not loaded.moving
        self._search.show(ready=found is None)
        effects = found is not None and bool(found.findings)
        self._verdict.visible = self._bars.visible = self._give_folder.visible = found is not None
        self._findings.visible = effects
        self._apply.visible = found is not None and (effects or found.before != found.after)
        self._model.visible = found is not None and bool(found.model)
        self._apply.label = self._pendant.t("compare.take_out" if loaded.applied else "compare.apply")
        self._next.visible = found is not None and bool(found.next_poses)
        self._next.value = False
        self._reveal.visible = bool(loaded.truth)
        self._truth.content = ""
        if found is not None:
            self._verdict.content = cards.verdict(pendant, found)
            self._bars.content = plots.bars(found)
            self._findings.content = cards.findings(pendant, found)
        self._choices(loaded)
        self._draw()

    def _choices(self, loaded: Loaded) -> None:
        """What can be plotted: joints of a log, drivers of poses."""
        if loaded.moving:
            self._curves = {}
            names = loaded.evidence.components
        else:
            self._curves = {c.driver: c for c in driver_curves(_as_shown(loaded), loaded.robot, most=12)}
            names = tuple(self._curves) or ("-",)
        self._driver.options = names
        self._driver.value = names[loaded.telling_joint if loaded.moving else 0]
        self._plot()

    # What somebody does ----------------------------------------------------------------------------------

    def _slide(self, value: float) -> None:
        self._pendant.worker.halt("compare.play")
        self._index = int(value) - 1
        self._draw()

    def _put_in(self) -> None:
        """The findings into the simulation, or out again: the arrows go where they belong, visibly."""
        from dataclasses import replace

        loaded = self._kept.loaded
        if loaded is None or loaded.diagnosis is None:
            return
        on = not loaded.applied
        self._kept.loaded = replace(loaded, applied=on)
        self._apply.label = self._pendant.t("compare.take_out" if on else "compare.apply")
        self._pendant.worker.animate("compare.morph", self._morph(1.0 if on else 0.0))
        before, after = loaded.diagnosis.before, loaded.diagnosis.after
        words = {"before": cards.measure(before.heldout_rms, before.unit)}
        words["after"] = cards.measure(after.heldout_rms, after.unit)
        self._pendant.say(
            "good" if on else "info", self._pendant.t(f"compare.put_{'in' if on else 'out'}", **words)
        )

    def _morph(self, goal: float) -> Iterator[None]:
        start, begun = self._share, time.monotonic()
        while (passed := (time.monotonic() - begun) / _MORPH_S) < 1.0:
            self._share = start + (goal - start) * passed * passed * (3.0 - 2.0 * passed)
            self._draw(quick=True)
            yield
        self._share = goal
        self._draw()

    def _start_play(self) -> None:
        self._pendant.worker.animate("compare.play", self._playing())

    def _playing(self) -> Iterator[None]:
        loaded = self._kept.loaded
        seconds = loaded.evidence.seconds if loaded is not None else None
        if loaded is None or seconds is None:
            return
        first = 0 if self._index >= loaded.count - 1 else self._index
        span = float(seconds[-1] - seconds[first])
        lasts = min(max(span, _PLAY_S[0]), _PLAY_S[1])
        begun = time.monotonic()
        while (passed := (time.monotonic() - begun) / lasts) < 1.0:
            now = seconds[first] + passed * span
            self._index = min(int(seconds.searchsorted(now)), loaded.count - 1)
            self._row.value = self._index + 1
            self._draw(quick=True)
            yield
        self._index = loaded.count - 1
        self._row.value = loaded.count
        self._draw()

    def _show_next(self, on: bool) -> None:
        loaded = self._kept.loaded
        if self._drawing is not None and loaded is not None and loaded.diagnosis is not None:
            self._drawing.next_poses(loaded.diagnosis.next_poses if on else ())

    def _show_truth(self) -> None:
        if self._kept.loaded is not None:
            self._truth.content = cards.truth(self._pendant, self._kept.loaded.truth)

    def _leave(self) -> None:
        """Back to the trainee's own arm."""
        self._search.stop()
        self._clear()
        self._kept.loaded = None
        self._pendant.stage.make_room(False)
        self._pendant.stage.view("whole")
        for widget in (
            self._about, self._row, self._row_text, self._play, self._verdict, self._apply, self._bars,
            self._findings, self._next, self._plot_folder, self._looks, self._give_folder, self._close,
        ):  # fmt: skip
            widget.visible = False
        self._search.show(ready=False)
        self._intro.visible = self._source_folder.visible = True

    # What is drawn ---------------------------------------------------------------------------------------

    def _draw(self, *, quick: bool = False) -> None:
        loaded, drawing = self._kept.loaded, self._drawing
        if loaded is None or drawing is None:
            return
        self._index = min(max(self._index, 0), loaded.count - 1)
        factor = float(self._factor.value.removeprefix("× "))
        drawing.row(self._index, self._share, factor)
        if not loaded.moving:
            drawing.arrows(self._index, self._share, factor, shown=self._arrows.value)
        self._row_text.content = cards.row(self._pendant, loaded, self._index, self._share)
        if loaded.moving and (not quick or time.monotonic() - self._traced > _TRACE_S):
            self._plot()

    def _plot(self) -> None:
        loaded = self._kept.loaded
        if loaded is None:
            return
        if loaded.moving:
            self._traced = time.monotonic()
            names, seconds = loaded.evidence.components, loaded.evidence.seconds
            joint = names.index(self._driver.value) if self._driver.value in names else 0
            at = None if seconds is None else float(seconds[self._index])
            self._plot_html.content = plots.trace(loaded.evidence, joint, loaded.diagnosis, at)
        else:
            curve = self._curves.get(self._driver.value)
            self._plot_html.content = plots.curve(curve) if curve is not None else ""

    def _clear(self) -> None:
        for name in ("compare.morph", "compare.play"):
            self._pendant.worker.halt(name)
        if self._drawing is not None:
            self._drawing.remove()
            self._drawing = None

    # What the page asks ----------------------------------------------------------------------------------

    def refresh(self, state: SessionState) -> None:
        pass

    def close(self) -> None:
        self._search.stop()
        self._drawing = None


def _as_shown(loaded: Loaded) -> Diagnosis:
    """A diagnosis to plot from: the real one, or before the search one without findings."""
    return loaded.diagnosis if loaded.diagnosis is not None else nothing_yet(loaded)


def nothing_yet(loaded: Loaded) -> Diagnosis:
    from app.diagnosis.result import Leftover, Noise, Quality

    unknown = Quality(float("nan"), float("nan"), "mm")
    return Diagnosis(
        file=str(loaded.path), kind="", robot=loaded.robot.name, samples=loaded.count, verdict="clean",
        noise=Noise(float("nan"), "mm", "residual"), before=unknown, after=unknown, findings=(), outliers=(),
        leftover=Leftover(1.0, {}), next_poses=(), seconds=0.0, evidence=loaded.evidence,
    )  # fmt: skip


class _Compare:
    key, order = "compare", 30

    def build(self, pendant: Pendant) -> _View:
        return _View(pendant)


SCREEN = _Compare()
