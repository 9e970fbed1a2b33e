"""A saved model that somebody brings: beside the recording, in a recorded cell, in the practice cell."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from app.diagnosis.model import SavedModel, load_model
from app.panel import Upload
from app.screens._compare import cards
from app.screens._compare.kept import Kept
from app.screens.taking_in import take_small
from app.session.actions import UseModel

if TYPE_CHECKING:
    from app.screens.context import Context

_LARGEST = 5_000_000  # bytes


class GivenModel:
    """The folder of the saved model.

    Args:
        context: where it stands.
        kept: holds the model beyond a reload.
        changed: called on the worker when another model, or none, is given.
        record: called on the worker to record in a cell with it.
    """

    def __init__(self, context: Context, kept: Kept, changed: Callable[[], None], record: Callable[[], None]):
        self._context, self._kept, self._changed = context, kept, changed
        ui, t = context.ui, context.t
        self.folder = ui.add_folder(t("compare.saved"), expanded=False)
        with self.folder:
            upload = ui.add_upload(t("compare.send_model"), hint=t("compare.send_model_hint"), accept=".json")
            self._said = ui.add_html("")
            self._record = ui.add_button(
                t("compare.make_with"), hint=t("compare.make_with_hint"), rank="plain"
            )
            context.clicked(self._record, record)
            self._cell = ui.add_button(t("compare.to_cell"), hint=t("compare.to_cell_hint"), rank="plain")
            context.clicked(self._cell, self._into_cell)
            self._away = ui.add_button(t("compare.model_away"), rank="plain")
            context.clicked(self._away, self._forget)

        context.uploaded(upload, lambda files: self._uploaded(files[0]))
        self.show()

    def show(self) -> None:
        """What is given, and what can be done with it."""
        model = self._kept.model
        self._said.content = cards.model(self._context, model, self._kept.model_name)
        in_cell = self._context.session.state.cell_model is not None
        self._record.visible = model is not None
        self._cell.visible = model is not None and model.kind == "static"
        self._away.visible = model is not None or in_cell

    def take(self, model: SavedModel, name: str) -> None:
        """This model is the given one from now on."""
        self._kept.model, self._kept.model_name = model, name
        self.show()

    def _uploaded(self, file: Upload) -> None:
        context = self._context

        def use(model: SavedModel) -> None:
            self.take(model, file.name)
            context.say("good", context.t("compare.model_given", name=file.name))
            self._changed()

        take_small(context, file, _LARGEST, load_model, use)

    def _into_cell(self) -> None:
        self._context.do(UseModel(self._kept.model))
        self.show()
        self._context.say("good", self._context.t("compare.in_cell"))

    def _forget(self) -> None:
        self._kept.model, self._kept.model_name = None, ""
        if self._context.session.state.cell_model is not None:
            self._context.do(UseModel(None))
        self.show()
        self._context.say("info", self._context.t("compare.model_gone"))
        self._changed()
