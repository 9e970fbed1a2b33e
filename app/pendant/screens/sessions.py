"""All recorded sessions: list, open, play again, export, take in."""

from __future__ import annotations

import tempfile
import time
from typing import TYPE_CHECKING, Any

from app.errors import InputError
from app.pendant import html
from app.pendant.screens._sessions.replaying import back, played, summary
from app.pendant.uploads import put
from app.session import SessionState, replay
from app.session.journal import encode_journal, read_journal
from app.session.state import robot_named
from app.session.store import Listed

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_MOTION = "replay"
_SHOWN = 30
_LARGEST = 20_000_000  # bytes of a journal somebody may send


class _View:
    def __init__(self, pendant: Pendant):
        self._pendant = pendant
        gui, t = pendant.client.gui, pendant.t
        gui.add_html(html.paragraph(t("sessions.intro"), faint=True))
        self._list: Any = gui.add_dropdown(t("sessions.session"), ("-",))
        pendant.changed(self._list, "session", lambda _: self._about())
        self._text = gui.add_html("")
        jobs = {
            t("sessions.open"): self._open,
            t("sessions.play"): self._play,
            t("sessions.export"): self._export,
        }
        group = gui.add_button_group(t("sessions.with"), tuple(jobs))
        pendant.chosen(group, lambda label: jobs[label]())
        self._stop_button = gui.add_button(t("sessions.stop"), visible=False, color="yellow")
        pendant.clicked(self._stop_button, self._stop)
        self._told = gui.add_html("")
        pendant.clicked(gui.add_button(t("sessions.again"), color="gray"), self._fill)
        upload = gui.add_upload_button(t("sessions.take"), hint=t("sessions.take_hint"))

        @upload.on_upload
        async def _(event) -> None:
            file = event.target.value
            pendant.post(lambda: self._take(file.name, file.content))

        self._sessions: dict[str, Listed] = {}
        self._fill()

    def _fill(self, chosen: str | None = None) -> None:
        pendant = self._pendant
        self._sessions = {self._title(s): s for s in pendant.shelf.store.list(_SHOWN)}
        self._list.options = tuple(self._sessions) or ("-",)
        wanted = chosen or pendant.session.name
        self._list.value = next(
            (t for t, s in self._sessions.items() if s.name == wanted), self._list.options[0]
        )
        self._about()

    def _title(self, listed: Listed) -> str:
        began = time.strftime("%m-%d %H:%M", time.localtime(listed.created))
        mine = "● " if listed.name == self._pendant.session.name else ""
        robot = robot_named(listed.robot).said("title", self._pendant.language) if listed.robot else "?"
        return f"{mine}{began} · {robot} · {listed.actions} · {listed.name[:6]}"

    @property
    def _chosen(self) -> Listed:
        listed = self._sessions.get(str(self._list.value))
        if listed is None:
            raise InputError(self._pendant.t("sessions.none"))
        return listed

    def _about(self) -> None:
        t, listed = self._pendant.t, self._sessions.get(str(self._list.value))
        if listed is None:
            self._text.content = ""
            return
        points, tool = summary(self._pendant.shelf.store.state(listed.name))
        last = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(listed.last))
        rows = [
            (t("sessions.last"), last),
            (t("sessions.actions"), str(listed.actions)),
            (t("sessions.points"), str(points)),
            (t("sessions.tool"), tool or "-"),
        ]
        self._text.content = html.table(rows, testid="session-facts", widths=("40%", "60%"))

    def _open(self) -> None:
        pendant, listed = self._pendant, self._chosen
        if listed.name == pendant.session.name:
            pendant.say("info", pendant.t("sessions.is_open"))
        elif pendant.shelf.in_use(listed.name):
            pendant.say("warning", pendant.t("sessions.in_use"))
        else:
            pendant.shelf.switch(pendant.client.client_id, listed.name)

    def _export(self) -> None:
        pendant, listed = self._pendant, self._chosen
        recorded = pendant.shelf.store.recorded(listed.name)
        if replay(recorded).running is not None:  # what is hidden follows from the journal
            pendant.say("warning", pendant.t("sessions.secret"))
            return
        name = f"session_{listed.name[:8]}.jsonl"
        pendant.client.send_file_download(
            name, encode_journal(recorded.header, recorded.entries), save_immediately=True
        )
        pendant.say("good", pendant.t("sessions.exported", name=name))

    def _take(self, name: str, content: bytes) -> None:
        pendant = self._pendant
        with tempfile.TemporaryDirectory() as folder:
            path = put(pendant, folder, name, content, otherwise="session.jsonl", most=_LARGEST)
            if path is None:
                return
            recorded = read_journal(path)
            replay(recorded)  # what cannot be replayed is not taken in
        self._fill(pendant.shelf.store.take(recorded))
        pendant.say("good", pendant.t("sessions.taken", name=name))

    def _play(self) -> None:
        pendant = self._pendant
        pendant.jogging.must_not_be_stopped()
        recorded = pendant.shelf.store.recorded(self._chosen.name)
        self._stop_button.visible = True
        pendant.stage.handle.visible = False

        def told(number: int, clock: str, tag: str, state: SessionState) -> None:
            words = pendant.t("sessions.step", number=number, all=len(recorded.entries), time=clock)
            action = pendant.t(f"sessions.do_{tag}")
            points = pendant.t("sessions.then", points=len(state.captures), steps=len(state.steps))
            self._told.content = html.instruction(f"{words}: {action}", points)

        def steps():
            yield from played(pendant, recorded, told)
            self._stop()

        pendant.worker.animate(_MOTION, steps())

    def _stop(self) -> None:
        """The replay ends; the arm stands where this session has it."""
        pendant = self._pendant
        pendant.worker.halt(_MOTION)
        self._stop_button.visible = False
        pendant.stage.handle.visible = pendant.stage.show_handle
        back(pendant)

    def refresh(self, state: SessionState) -> None:
        pass

    def close(self) -> None:
        """The page goes: a replay ends."""
        self._pendant.worker.halt(_MOTION)


class _Sessions:
    key, order = "sessions", 80

    def build(self, pendant: Pendant) -> _View:
        return _View(pendant)


SCREEN = _Sessions()
