"""Compare: a recording beside the simulation; find what the simulation leaves out, and put it in."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.report.wording import measure, verdict_sentence
from app.diagnosis.result import Diagnosis
from app.kinematics import RobotModel
from app.screens._compare import cards
from app.screens._compare.drawing import Drawing, instead
from app.screens._compare.finding import Search
from app.screens._compare.given_model import GivenModel
from app.screens._compare.kept import kept_for
from app.screens._compare.loaded import Loaded
from app.screens._compare.moments import Moments
from app.screens._compare.outcome import Outcome
from app.screens._compare.plotting import Plotting
from app.screens._compare.sources import Sources
from app.screens._compare.taking import Taking
from app.session import SessionState

if TYPE_CHECKING:
    from app.screens.context import Context

_FACTORS = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1_000, 2_000, 5_000)
_MORPH_S = 1.2  # how long the arrows take to shrink
_LEVELS = {"clean": "good", "named": "good", "partly": "warning", "unexplained": "warning"}


class _View:
    """The parts of the screen, from top to bottom, and what passes between them."""

    def __init__(self, context: Context):
        self._context, self._kept = context, kept_for(context.session.name)
        self._drawing: Drawing | None = None
        self._share = 0.0
        ui, t = context.ui, context.t
        self._intro = ui.add_html(cards.html.paragraph(t("compare.intro"), testid="compare-intro"))
        self._source_folder = ui.add_folder(t("compare.source"))
        with self._source_folder:
            self._sources = Sources(context, self._kept, self._arrived)
        self._about = ui.add_html("", visible=False)
        self._moments = Moments(context, self._moved)
        self._search = Search(context, lambda: self._kept.loaded, self._found)
        self._outcome = Outcome(context, self._put_in, self._show_next)
        self._plots = Plotting(context, self._moments.below)
        self._looks = ui.add_folder(t("compare.looks"), visible=False, expanded=False)
        with self._looks:
            self._factor = ui.add_choice(t("compare.factor"), tuple(f"× {f}" for f in _FACTORS))
            context.changed(self._factor, "compare.factor", lambda _: self._draw())
            self._arrows = ui.add_check(t("compare.arrows"), True)
            context.changed(self._arrows, "compare.arrows", lambda _: self._draw())
        self._given = GivenModel(context, self._kept, self._model_changed, self._sources.record_with_model)
        self._taking = Taking(context, lambda: self._kept.loaded, self._given.take)
        self._close = ui.add_button(t("compare.close"), visible=False, rank="plain")
        context.clicked(self._close, self._leave)
        if self._kept.loaded is not None:
            loaded = self._kept.loaded
            context.post(lambda: self._arrived(loaded))

    # What arrives ----------------------------------------------------------------------------------------

    def _arrived(self, loaded: Loaded) -> None:
        """A recording is there: the trainee's own arm makes room for it."""
        self._search.stop()
        self._clear()
        self._kept.loaded = loaded
        self._context.show_instead(self._seen, lambda: instead(loaded, self._moments.index))
        self._drawing = Drawing(self._context.stage.scene, loaded)
        factor = min(_FACTORS, key=lambda f: abs(f - loaded.factor))
        self._factor.value = f"× {factor}"
        self._share = 1.0 if loaded.applied else 0.0
        self._show(loaded, loaded.worst)
        self._context.say(
            "info", self._context.t("compare.loaded", file=loaded.path.name, count=loaded.count)
        )

    def _seen(self) -> tuple[RobotModel, np.ndarray]:
        """The recording's arm, at the row that is shown; the own one while nothing is loaded any more."""
        loaded = self._kept.loaded
        if loaded is None:
            return self._context.model, self._context.q
        return loaded.robot, loaded.evidence.q[min(self._moments.index, loaded.count - 1)]

    def _found(self, loaded: Loaded, diagnosis: Diagnosis) -> None:
        if self._kept.loaded is not loaded:
            return  # another recording was loaded meanwhile
        place = self._moments.index / max(loaded.count - 1, 1)
        loaded = self._kept.loaded = loaded.with_diagnosis(diagnosis)
        self._share = 0.0
        if self._drawing is not None:
            self._drawing.update(loaded)
        self._show(loaded, round(place * (loaded.count - 1)))
        context = self._context
        words = verdict_sentence(diagnosis, context.language)
        context.spoken.remember(words, lambda language: verdict_sentence(diagnosis, language))
        context.say(_LEVELS[diagnosis.verdict], words)

    def _model_changed(self) -> None:
        """Another saved model was brought, or taken away: the shown recording stands beside it."""
        if self._kept.loaded is not None:
            self._search.stop()
            self._sources.again(self._kept.loaded)

    def _show(self, loaded: Loaded, index: int) -> None:
        """Every widget by what is known of the recording."""
        self._intro.visible = self._source_folder.visible = False
        self._about.content = cards.recording(self._context, loaded)
        self._about.visible = self._close.visible = True
        self._looks.visible = not loaded.moving
        self._search.show(ready=loaded.diagnosis is None)
        self._moments.show(loaded, index)
        self._outcome.show(loaded)
        self._taking.show(loaded)
        self._plots.show(loaded, self._moments.index)
        self._draw()

    # What somebody does ----------------------------------------------------------------------------------

    def _moved(self, playing: bool) -> None:
        self._draw(quick=playing)

    def _put_in(self) -> None:
        """The findings, or the given model, into the simulation or out again: the arrows follow, visibly."""
        loaded = self._kept.loaded
        if loaded is None or loaded.change is None:
            return
        on = not loaded.applied
        self._kept.loaded = replace(loaded, applied=on)
        self._outcome.switched(on)
        self._context.worker.animate("compare.morph", self._morph(1.0 if on else 0.0))
        before, after = (measure(quality.heldout_rms, quality.unit) for quality in loaded.change)
        words = self._context.t(f"compare.put_{'in' if on else 'out'}", before=before, after=after)
        self._context.say("good" if on else "info", words)

    def _morph(self, goal: float) -> Iterator[None]:
        start, begun = self._share, time.monotonic()
        while (passed := (time.monotonic() - begun) / _MORPH_S) < 1.0:
            self._share = start + (goal - start) * passed * passed * (3.0 - 2.0 * passed)
            self._draw(quick=True)
            yield
        self._share = goal
        self._draw()

    def _show_next(self, on: bool) -> None:
        loaded = self._kept.loaded
        if self._drawing is not None and loaded is not None and loaded.diagnosis is not None:
            self._drawing.next_poses(loaded.diagnosis.next_poses if on else ())

    def _leave(self) -> None:
        """Back to the trainee's own arm."""
        self._search.stop()
        self._clear()
        self._kept.loaded = None
        self._context.show_instead(None)
        for part in (self._moments, self._outcome, self._plots, self._taking):
            part.hide()
        self._about.visible = self._looks.visible = self._close.visible = False
        self._search.show(ready=False)
        self._intro.visible = self._source_folder.visible = True

    # What is drawn ---------------------------------------------------------------------------------------

    def _draw(self, *, quick: bool = False) -> None:
        loaded, drawing, index = self._kept.loaded, self._drawing, self._moments.index
        if loaded is None or drawing is None:
            return
        factor = float(self._factor.value.removeprefix("× "))
        drawing.row(index, self._share, factor)
        if not loaded.moving:
            drawing.arrows(index, self._share, factor, shown=self._arrows.value)
        self._moments.say(loaded, self._share)
        self._plots.moment(index, quick=quick)

    def _clear(self) -> None:
        self._context.worker.halt("compare.morph")
        self._moments.stop()
        if self._drawing is not None:
            self._drawing.remove()
            self._drawing = None

    # What the page asks ----------------------------------------------------------------------------------

    def refresh(self, state: SessionState) -> None:
        self._given.show()

    def close(self) -> None:
        self._search.stop()
        self._sources.reading.stop()
        self._drawing = None


class _Compare:
    key, order = "compare", 30

    def build(self, context: Context) -> _View:
        return _View(context)


SCREEN = _Compare()
