"""Where a recording comes from: sent from the browser, a file beside the server, or a simulated cell."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from app.diagnosis.model import SavedModel
from app.errors import InputError
from app.kinematics import robot_names
from app.panel import Upload
from app.screens._cell.own_arm import OwnArm
from app.screens._compare.hidden import KINDS
from app.screens._compare.jobs import Arrived, read_again, read_drop, record_hidden, record_with
from app.screens._compare.kept import Kept
from app.screens._compare.loaded import Loaded
from app.screens._compare.reading import Reading
from app.session.state import robot_named

if TYPE_CHECKING:
    from app.screens.context import Context

_LARGEST = 400_000_000  # bytes somebody may drop at once


class Sources:
    """The widgets that load; `loaded` is called on the worker with what was read."""

    def __init__(self, context: Context, kept: Kept, loaded: Callable[[Loaded], None]):
        self._context, self._kept, self._loaded = context, kept, loaded
        ui, t = context.ui, context.t
        self._as_said = t("compare.robot_as_said")
        self._own = {f"{title} *": name for title, name in OwnArm.titles_of(context).items()}
        self.robot = ui.add_choice(t("compare.robot"), (self._as_said, *robot_names(), *self._own))
        upload = ui.add_upload(t("compare.upload"), hint=t("compare.upload_hint"), several=True)
        context.uploaded(upload, self._dropped)
        self.reading = Reading(context, self._came)
        if context.shelf.person is None:  # where people log in, what lies on the server is not theirs to read
            self.path = ui.add_text(t("compare.path"), "", hint=t("compare.path_hint"))
            context.clicked(ui.add_button(t("compare.load"), rank="plain"), self._from_path)
        self._kinds = {t(f"compare.kind_{kind}"): kind for kind in KINDS}
        self.kind = ui.add_choice(t("compare.kind"), tuple(self._kinds))
        make = ui.add_button(t("compare.make"), hint=t("compare.make_hint"), rank="plain")
        context.clicked(make, self._made)

    def _named(self) -> str | None:
        if self.robot.value in self._own:
            return robot_named(self._own[self.robot.value]).address
        if self.robot.value != self._as_said:
            return self.robot.value
        return None if self._kept.urdf is None else str(self._kept.urdf)

    def _dropped(self, files: tuple[Upload, ...]) -> None:
        context = self._context
        if sum(file.size for file in files) > _LARGEST:
            context.say("warning", context.t("compare.too_large", name=files[0].name))
            return
        sent, folder = self._kept.new_folder(), self._kept.new_folder()
        moved = tuple(
            replace(file, path=Path(shutil.move(file.path, sent / str(number))))
            for number, file in enumerate(files)
        )
        words = context.t("compare.reading", name=files[0].name)
        self.reading.start(words, read_drop, moved, folder, self._named(), self._kept.model)

    def _came(self, arrived: Arrived) -> None:
        if arrived.description is not None:
            self._kept.urdf = arrived.description
            name = arrived.description.name
            self._context.say("info", self._context.t("compare.urdf", name=name))
        if arrived.loaded is not None:
            self._loaded(arrived.loaded)

    def _from_path(self) -> None:
        """Only below the folder the server was started in: a browser elsewhere is no reader of this machine."""
        text = self.path.value.strip()
        root = Path.cwd().resolve()
        path = (root / text).resolve()
        if not text or not path.is_relative_to(root):
            raise InputError(
                f"{text or 'nothing'} is not a file below the server's folder",
                expected="a path below the folder it was started in",
            )
        words = self._context.t("compare.reading", name=path.name)
        self.reading.start(words, read_again, path, self._named(), (), self._kept.model)

    def record_with_model(self) -> None:
        """A recording from a cell in which the given model is true."""
        model, context = self._kept.model, self._context
        if model is None:
            return
        robot, seed = context.model.address, self._seed()
        kind = self._kinds[self.kind.value]
        if model.kind == "motion" or kind == "motion":
            kind = "motion" if model.kind == "motion" else "tracker"
        words = context.t("compare.making", kind=context.t(f"compare.kind_{kind}"))
        self.reading.start(words, record_with, robot, kind, self._kept.folder, seed, model)

    def again(self, loaded: Loaded) -> None:
        """The same recording beside the model that is given now."""
        words = self._context.t("compare.reading", name=loaded.path.name)
        self.reading.start(words, read_again, loaded.path, loaded.named, loaded.truth, self._kept.model)

    def _made(self) -> None:
        context, kept = self._context, self._kept
        robot, kind, seed = context.model.address, self._kinds[self.kind.value], self._seed()
        words = context.t("compare.making", kind=self.kind.value)
        self.reading.start(words, record_hidden, robot, kind, kept.folder, seed, self._fitting(kind))

    def _fitting(self, kind: str) -> SavedModel | None:
        """The given model, where it is one for such a recording."""
        model = self._kept.model
        return model if model is not None and (model.kind == "motion") == (kind == "motion") else None

    def _seed(self) -> int:
        return int(self._context.rng.integers(1, 10**6))
