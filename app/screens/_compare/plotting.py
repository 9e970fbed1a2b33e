"""What the error follows: residual against a driver, or a joint's torque over time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from app.diagnosis.report.curves import Curve, driver_curves
from app.diagnosis.report.picture_words import in_language
from app.diagnosis.result import Diagnosis, Leftover, Noise, Quality
from app.screens._compare import plots
from app.screens._compare.loaded import Loaded

if TYPE_CHECKING:
    from app.screens.context import Context

_TRACE_S = 0.4  # seconds between two pictures of a trace while it plays
_MOST = 12  # drivers to choose from


class Plotting:
    """A choice of drivers or joints, and the picture.

    Args:
        context: where they stand.
        early: place of a log's torques in the order of the panel.
    """

    def __init__(self, context: Context, early: float):
        self._context, self._early = context, early
        self._loaded: Loaded | None = None
        self._curves: dict[str, Curve] = {}
        self._index, self._drawn_at = 0, 0.0
        ui, t = context.ui, context.t
        self.folder = ui.add_folder(t("compare.plots"), visible=False)
        self._late = self.folder.order
        with self.folder:
            self._what: Any = ui.add_choice(t("compare.against"), ("-",))
            context.changed(self._what, "compare.driver", lambda _: self._draw())
            self._html = ui.add_html("")

    def show(self, loaded: Loaded, index: int) -> None:
        """What can be plotted of this recording: joints of a log, drivers of poses."""
        self._loaded, self._index = loaded, index
        # The torques of a log belong to the slider above them; what poses' errors follow comes after the findings.
        self.folder.order = self._early if loaded.moving else self._late
        self.folder.label = self._context.t("compare.torques" if loaded.moving else "compare.plots")
        if loaded.moving:
            self._curves, first = {}, loaded.telling_joint
            self._names = tuple(
                in_language(name, self._context.language) for name in loaded.evidence.components
            )
        else:
            found = loaded.diagnosis if loaded.diagnosis is not None else _nothing_yet(loaded)
            curves = driver_curves(found, loaded.robot, most=_MOST)
            self._curves = {in_language(c.driver, self._context.language): c for c in curves}
            self._names, first = tuple(self._curves) or ("-",), 0
        self.folder.visible = True
        self._what.options = self._names
        self._what.value = self._names[first]
        self._draw()

    def moment(self, index: int, *, quick: bool) -> None:
        """Another row is shown: the line in a log's picture moves, `quick` not more often than an eye needs."""
        self._index = index
        due = not quick or time.monotonic() - self._drawn_at > _TRACE_S
        if due and self._loaded is not None and self._loaded.moving:
            self._draw()

    def hide(self) -> None:
        self._loaded, self.folder.visible = None, False

    def _draw(self) -> None:
        loaded, language = self._loaded, self._context.language
        if loaded is None:
            return
        self._drawn_at = time.monotonic()
        if loaded.moving:
            joint = self._names.index(self._what.value) if self._what.value in self._names else 0
            at = loaded.moment(self._index) + loaded.start
            self._html.content = plots.trace(loaded.evidence, joint, loaded.diagnosis, at, language)
        else:
            curve = self._curves.get(self._what.value)
            found = loaded.diagnosis is not None
            self._html.content = plots.curve(curve, language, found=found) if curve is not None else ""


def _nothing_yet(loaded: Loaded) -> Diagnosis:
    """A diagnosis to plot from before the search: without findings."""
    unknown = Quality(float("nan"), float("nan"), "mm")
    return Diagnosis(
        file=str(loaded.path), kind="", robot=loaded.robot.name, samples=loaded.count, verdict="clean",
        noise=Noise(float("nan"), "mm", "residual"), before=unknown, after=unknown, findings=(), outliers=(),
        leftover=Leftover(1.0, {}), next_poses=(), seconds=0.0, evidence=loaded.evidence,
    )  # fmt: skip
