"""Where a recording comes from: sent from the browser, a file beside the server, or a simulated cell."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from app.diagnosis.model import SavedModel
from app.errors import InputError
from app.kinematics import robot_names
from app.pendant.screens._compare.hidden import KINDS, make_hidden, make_with
from app.pendant.screens._compare.kept import Kept
from app.pendant.screens._compare.loaded import Loaded, load
from app.pendant.uploads import put

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_LARGEST = 200_000_000  # bytes somebody may send


class Sources:
    """The widgets that load; `loaded` is called on the worker with what was read."""

    def __init__(self, pendant: Pendant, kept: Kept, loaded: Callable[[Loaded], None]):
        self._pendant, self._kept, self._loaded = pendant, kept, loaded
        gui, t = pendant.client.gui, pendant.t
        self._as_said = t("compare.robot_as_said")
        self.robot = gui.add_dropdown(t("compare.robot"), (self._as_said, *robot_names()))
        upload = gui.add_upload_button(t("compare.upload"), hint=t("compare.upload_hint"))

        @upload.on_upload
        async def _(event) -> None:
            file = event.target.value
            pendant.post(lambda: self._uploaded(file.name, file.content))

        self.path = gui.add_text(t("compare.path"), "", hint=t("compare.path_hint"))
        pendant.clicked(gui.add_button(t("compare.load")), self._from_path)
        self._kinds = {t(f"compare.kind_{kind}"): kind for kind in KINDS}
        self.kind = gui.add_dropdown(t("compare.kind"), tuple(self._kinds))
        make = gui.add_button(t("compare.make"), hint=t("compare.make_hint"), color="gray")
        pendant.clicked(make, self._made)

    def _named(self) -> str | None:
        if self.robot.value != self._as_said:
            return self.robot.value
        return None if self._kept.urdf is None else str(self._kept.urdf)

    def _uploaded(self, name: str, content: bytes) -> None:
        pendant = self._pendant
        path = put(
            pendant,
            self._kept.folder,
            name,
            content,
            otherwise="recording.csv",
            most=_LARGEST,
            refusal="compare.too_large",
        )
        if path is None:
            return
        if path.suffix.lower() in (".urdf", ".xml"):
            self._kept.urdf = path
            pendant.say("info", pendant.t("compare.urdf", name=path.name))
            return
        self._read(path, self._named())

    def _from_path(self) -> None:
        """Only below the folder the server was started in: a browser elsewhere is no reader of this machine."""
        text = self.path.value.strip()
        root = Path.cwd().resolve()
        path = (root / text).resolve()
        if not text or not path.is_relative_to(root):
            raise InputError(
                f"{text or 'nothing'} is not a file below the server's folder",
                expected=f"a path below {root}",
            )
        self._read(path, self._named())

    def record_with_model(self) -> None:
        """A recording from a cell in which the given model is true."""
        model, pendant = self._kept.model, self._pendant
        if model is None:
            return
        robot, seed = pendant.session.state.robot, self._seed()
        kind = self._kinds[self.kind.value]
        if model.kind == "motion" or kind == "motion":
            kind = "motion" if model.kind == "motion" else "tracker"
        pendant.say("info", pendant.t("compare.making", kind=pendant.t(f"compare.kind_{kind}")))

        def job() -> Loaded:
            return load(make_with(robot, kind, model, self._kept.folder, seed), model=model)

        pendant.background(job, self._loaded)

    def again(self, loaded: Loaded) -> None:
        """The same recording beside the model that is given now."""
        model = self._kept.model
        self._pendant.background(
            lambda: load(loaded.path, robot=loaded.named, truth=loaded.truth, model=model), self._loaded
        )

    def _made(self) -> None:
        pendant = self._pendant
        robot, kind, seed = pendant.session.state.robot, self._kinds[self.kind.value], self._seed()
        pendant.say("info", pendant.t("compare.making", kind=self.kind.value))

        def job() -> Loaded:
            path, truth = make_hidden(robot, kind, self._kept.folder, seed)
            return load(path, truth=truth, model=self._fitting(kind))

        pendant.background(job, self._loaded)

    def _fitting(self, kind: str) -> SavedModel | None:
        """The given model, where it is one for such a recording."""
        model = self._kept.model
        return model if model is not None and (model.kind == "motion") == (kind == "motion") else None

    def _seed(self) -> int:
        return int(self._pendant.rng.integers(1, 10**6))

    def _read(self, path: Path, named: str | None) -> None:
        self._pendant.say("info", self._pendant.t("compare.reading", name=path.name))
        model = self._kept.model
        self._pendant.background(lambda: load(path, robot=named, model=model), self._loaded)
