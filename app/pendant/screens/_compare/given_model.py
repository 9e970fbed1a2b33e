"""A saved model that somebody brings: beside the recording, in a recorded cell, in the practice cell."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from app.diagnosis.model import SavedModel, load_model
from app.pendant.screens._compare import cards
from app.pendant.screens._compare.kept import Kept
from app.pendant.uploads import put
from app.session.actions import UseModel

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_LARGEST = 5_000_000  # bytes


class GivenModel:
    """The folder of the saved model.

    Args:
        pendant: where it stands.
        kept: holds the model beyond a reload.
        changed: called on the worker when another model, or none, is given.
        record: called on the worker to record in a cell with it.
    """

    def __init__(self, pendant: Pendant, kept: Kept, changed: Callable[[], None], record: Callable[[], None]):
        self._pendant, self._kept, self._changed = pendant, kept, changed
        gui, t = pendant.client.gui, pendant.t
        self.folder = gui.add_folder(t("compare.saved"), expand_by_default=False)
        with self.folder:
            upload = gui.add_upload_button(
                t("compare.send_model"), hint=t("compare.send_model_hint"), mime_type=".json", color="gray"
            )
            self._said = gui.add_html("")
            self._record = gui.add_button(
                t("compare.make_with"), hint=t("compare.make_with_hint"), color="gray"
            )
            pendant.clicked(self._record, record)
            self._cell = gui.add_button(t("compare.to_cell"), hint=t("compare.to_cell_hint"), color="gray")
            pendant.clicked(self._cell, self._into_cell)
            self._away = gui.add_button(t("compare.model_away"), color="gray")
            pendant.clicked(self._away, self._forget)

        @upload.on_upload
        async def _(event) -> None:
            file = event.target.value
            pendant.post(lambda: self._uploaded(file.name, file.content))

        self.show()

    def show(self) -> None:
        """What is given, and what can be done with it."""
        model = self._kept.model
        self._said.content = cards.model(self._pendant, model, self._kept.model_name)
        in_cell = self._pendant.session.state.cell_model is not None
        self._record.visible = model is not None
        self._cell.visible = model is not None and model.kind == "static"
        self._away.visible = model is not None or in_cell

    def take(self, model: SavedModel, name: str) -> None:
        """This model is the given one from now on."""
        self._kept.model, self._kept.model_name = model, name
        self.show()

    def _uploaded(self, name: str, content: bytes) -> None:
        pendant = self._pendant
        path = put(
            pendant,
            self._kept.folder,
            name,
            content,
            otherwise="model.json",
            most=_LARGEST,
            refusal="compare.too_large",
        )
        if path is None:
            return
        self.take(load_model(path), path.name)
        pendant.say("good", pendant.t("compare.model_given", name=path.name))
        self._changed()

    def _into_cell(self) -> None:
        self._pendant.do(UseModel(self._kept.model))
        self.show()
        self._pendant.say("good", self._pendant.t("compare.in_cell"))

    def _forget(self) -> None:
        self._kept.model, self._kept.model_name = None, ""
        if self._pendant.session.state.cell_model is not None:
            self._pendant.do(UseModel(None))
        self.show()
        self._pendant.say("info", self._pendant.t("compare.model_gone"))
        self._changed()
