"""The folder in which somebody brings an arm of his own, and takes one away again."""

from __future__ import annotations

import shutil
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from app.apart import DESCRIPTION, apart
from app.errors import InputError
from app.panel import Upload
from app.panel import markup as html
from app.people.limits import ARM, ARMS
from app.screens._cell.bringing import bring
from app.session.actions import ChooseRobot
from app.session.arms import Packed
from app.session.refusals import refusal
from app.session.state import robot_named

if TYPE_CHECKING:
    from app.screens.context import Context

_LARGEST = 200_000_000  # bytes somebody may drop at once; the largest public packages of one arm have so many
_NAMED = 3  # missing meshes named in a message


class OwnArm:
    """A place to drop a description, which part of it is the arm, and the arms there are.

    Args:
        context: whose page.
    """

    def __init__(self, context: Context):
        self._context, self._busy = context, False
        ui, t = context.ui, context.t
        with ui.add_folder(t("cell.own"), expanded=False):
            ui.add_html(html.paragraph(t("cell.own_about", most=ARMS), faint=True))
            self._part = ui.add_text(t("cell.part"), "", hint=t("cell.part_hint"))
            upload = ui.add_upload(t("cell.bring"), hint=t("cell.bring_hint"), several=True)
            context.uploaded(upload, self._dropped)
            self._reading = ui.add_html("", visible=False)
            self._mine = ui.add_choice(t("cell.own_arms"), ("-",), visible=False)
            self._away = ui.add_button(t("cell.take_away"), rank="quiet", visible=False)
            context.clicked(self._away, self._take_away)
        self._list()

    @staticmethod
    def titles_of(context: Context) -> dict[str, str]:
        """Title, each once -> name of the arms of whoever has this session open."""
        titles: dict[str, str] = {}
        for name, title in context.shelf.arms.of(context.shelf.owner).items():
            titles[title if title not in titles else name] = name
        return titles

    def _list(self) -> None:
        """The arms that can be taken away."""
        titles = tuple(self.titles_of(self._context))
        self._mine.visible = self._away.visible = bool(titles)
        if titles:
            self._mine.options, self._mine.value = titles, titles[-1]

    def _dropped(self, files: tuple[Upload, ...]) -> None:
        context, shelf = self._context, self._context.shelf
        if context.session.state.running is not None:
            raise refusal("exercise_runs")
        if self._busy:
            raise InputError(context.t("cell.busy"))
        if len(shelf.arms.of(shelf.owner)) >= ARMS:
            raise InputError(context.t("cell.full", most=ARMS))
        if sum(file.size for file in files) > _LARGEST:
            raise InputError(context.t("message.too_large", name=files[0].name))
        folder = Path(tempfile.mkdtemp(prefix="teachframe-arm-"))
        sent = folder / "sent"
        sent.mkdir()
        moved = [
            replace(file, path=Path(shutil.move(file.path, sent / str(number))))
            for number, file in enumerate(files)
        ]
        inside = folder / "robot"
        inside.mkdir()
        part = self._part.value.strip()
        self._busy = True
        self._tell(context.t("cell.trying", name=files[0].name))

        def run() -> Packed | Exception:
            try:
                return apart(bring, moved, inside, part, ARM, bounds=DESCRIPTION)
            except Exception as error:
                return error
            finally:
                shutil.rmtree(folder, ignore_errors=True)

        context.background(run, self._came)

    def _came(self, found: Packed | Exception) -> None:
        context = self._context
        self._busy = False
        self._tell("")
        if isinstance(found, Exception):
            raise found
        name = context.shelf.arms.keep(context.shelf.owner, found)
        context.do(ChooseRobot(name))
        robot = robot_named(name)
        words = context.t("cell.brought", title=robot.title, joints=robot.joint_count, flange=robot.flange)
        if found.said:
            missing = "; ".join(found.said[:_NAMED])
            context.say(
                "warning", f"{words} {context.t('cell.not_drawn', number=len(found.said), what=missing)}"
            )
        else:
            context.say("good", words)

    def _take_away(self) -> None:
        """An arm goes, where no session of the person's needs it."""
        context, shelf = self._context, self._context.shelf
        name = self.titles_of(context).get(str(self._mine.value))
        if name is None:
            return
        used = shelf.arms.used(shelf.owner, name)
        if used:
            raise InputError(context.t("cell.in_sessions", number=used))
        shelf.arms.delete(shelf.owner, name)
        context.rebuild()
        context.say("info", context.t("cell.taken_away", title=name.partition("~")[0]))

    def _tell(self, words: str) -> None:
        self._reading.content = html.paragraph(words, testid="own-arm-reading")
        self._reading.visible = bool(words)
