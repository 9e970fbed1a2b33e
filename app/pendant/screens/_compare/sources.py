"""Where a recording comes from: sent from the browser, a file beside the server, or a simulated cell."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from app.errors import InputError
from app.kinematics import robot_names
from app.pendant.screens._compare.hidden import KINDS, make_hidden
from app.pendant.screens._compare.kept import Kept
from app.pendant.screens._compare.loaded import Loaded, load

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
        self.kind = gui.add_dropdown(t("compare.kind"), KINDS)
        make = gui.add_button(t("compare.make"), hint=t("compare.make_hint"), color="gray")
        pendant.clicked(make, self._made)

    def _named(self) -> str | None:
        if self.robot.value != self._as_said:
            return self.robot.value
        return None if self._kept.urdf is None else str(self._kept.urdf)

    def _uploaded(self, name: str, content: bytes) -> None:
        pendant = self._pendant
        if len(content) > _LARGEST:
            pendant.say("warning", pendant.t("compare.too_large", name=name))
            return
        path = self._kept.folder / (Path(name).name or "recording.csv")
        path.write_bytes(content)
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

    def _made(self) -> None:
        pendant = self._pendant
        robot = pendant.session.state.robot
        kind, seed = self.kind.value, int(pendant.rng.integers(1, 10**6))
        pendant.say("info", pendant.t("compare.making", kind=kind))

        def job() -> Loaded:
            path, truth = make_hidden(robot, kind, self._kept.folder, seed)
            return load(path, truth=truth)

        pendant.background(job, self._loaded)

    def _read(self, path: Path, named: str | None) -> None:
        self._pendant.say("info", self._pendant.t("compare.reading", name=path.name))
        self._pendant.background(lambda: load(path, robot=named), self._loaded)
