"""The person's own sessions: list, open, name, play again, export, delete, take in."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from app.errors import InputError
from app.panel import Upload
from app.panel import markup as html
from app.screens._sessions.replaying import back, played, replayable, summary, title_of
from app.screens.taking_in import take_small
from app.session import SessionState, replay
from app.session.actions import Begin
from app.session.journal import Recorded, encode_journal
from app.session.report import moment
from app.session.store import Listed

if TYPE_CHECKING:
    from app.screens.context import Context

_MOTION = "replay"
_SHOWN = 60
_LARGEST = 20_000_000  # bytes of a journal somebody may send


class _View:
    def __init__(self, context: Context):
        self._context = context
        ui, t = context.ui, context.t
        ui.add_html(html.paragraph(t("sessions.intro"), faint=True))
        self._list: Any = ui.add_choice(t("sessions.session"), ("-",))
        context.changed(self._list, "session", lambda _: self._about())
        self._text = ui.add_html("")
        self._name = ui.add_text(t("sessions.name"), "")
        context.changed(self._name, "session-name", self._rename)
        jobs = {
            t("sessions.open"): self._open,
            t("sessions.play"): self._play,
            t("sessions.export"): self._export,
        }
        group = ui.add_buttons(t("sessions.with"), tuple(jobs))
        context.chosen(group, lambda label: jobs[label]())
        self._stop_button = ui.add_button(t("sessions.stop"), visible=False, rank="plain")
        context.clicked(self._stop_button, self._stop)
        self._told = ui.add_html("")
        with ui.add_folder(t("sessions.more"), expanded=False):
            context.clicked(ui.add_button(t("sessions.new"), rank="plain"), self._new)
            upload = ui.add_upload(t("sessions.take"), hint=t("sessions.take_hint"), accept=".jsonl")
            context.uploaded(upload, lambda files: self._take(files[0]))
            context.clicked(ui.add_button(t("sessions.again"), rank="plain"), self._fill)
            self._delete_button = ui.add_button(t("sessions.delete"), rank="quiet")
            context.clicked(self._delete_button, self._delete)
        self._sure = ""  # session whose deletion was asked for once
        self._sessions: dict[str, tuple[Listed, str]] = {}
        self._fill()

    def _fill(self, chosen: str | None = None) -> None:
        context = self._context
        self._sessions = {
            self._title(listed, name): (listed, name) for listed, name in context.shelf.mine(_SHOWN)
        }
        self._list.options = tuple(self._sessions) or ("-",)
        wanted = chosen or context.session.name
        self._list.value = next(
            (t for t, (s, _) in self._sessions.items() if s.name == wanted), self._list.options[0]
        )
        self._about()

    def _title(self, listed: Listed, name: str) -> str:
        began = moment(listed.created, "%m-%d %H:%M")
        mine = "● " if listed.name == self._context.session.name else ""
        robot = title_of(listed.robot, self._context.language)
        return f"{mine}{name or began} · {robot} · {listed.actions} · {listed.name[:6]}"

    @property
    def _chosen(self) -> Listed:
        found = self._sessions.get(str(self._list.value))
        if found is None or not self._context.shelf.may(found[0].name):
            raise InputError(self._context.t("sessions.none"))
        return found[0]

    def _about(self) -> None:
        t, found = self._context.t, self._sessions.get(str(self._list.value))
        self._sure, self._delete_button.label = "", t("sessions.delete")
        if found is None:
            self._text.content = ""
            return
        listed, self._name.value = found
        here = self._context.session
        own = listed.name == here.name  # its state is at hand: nothing is played anew
        points, tool = summary(here.state if own else self._context.shelf.store.state(listed.name))
        last = moment(listed.last, "%Y-%m-%d %H:%M:%S")
        rows = [
            (t("sessions.last"), last),
            (t("sessions.actions"), str(listed.actions)),
            (t("sessions.points"), str(points)),
            (t("sessions.tool"), tool or "-"),
        ]
        self._text.content = html.table(rows, testid="session-facts")

    def _open(self) -> None:
        context, listed = self._context, self._chosen
        if listed.name == context.session.name:
            context.say("info", context.t("sessions.is_open"))
        elif context.shelf.in_use(listed.name):
            context.say("warning", context.t("sessions.in_use"))
        else:
            context.shelf.switch(listed.name)

    def _new(self) -> None:
        context = self._context
        self._must_have_room()
        name = context.shelf.store.create(robot=context.session.state.robot)
        name.close()
        context.shelf.switch(name.name)

    def _rename(self, title: str) -> None:
        context, listed = self._context, self._chosen
        if listed.name in context.shelf.owners.nobodys():
            context.shelf.owners.give(listed.name, context.shelf.owner)
        context.shelf.owners.rename(listed.name, title)
        self._fill(listed.name)
        context.say("good", context.t("sessions.renamed"))

    def _delete(self) -> None:
        context, listed = self._context, self._chosen
        if context.shelf.in_use(listed.name):
            context.say("warning", context.t("sessions.in_use"))
            return
        if self._sure != listed.name:
            self._sure, self._delete_button.label = listed.name, context.t("sessions.delete_sure")
            return
        context.shelf.store.delete(listed.name)
        context.shelf.owners.forget(listed.name)
        self._fill()
        context.say("info", context.t("sessions.deleted"))

    def _export(self) -> None:
        context, listed = self._context, self._chosen
        recorded = context.shelf.store.recorded(listed.name)
        if replay(recorded).running is not None:  # what is hidden follows from the journal
            context.say("warning", context.t("sessions.secret"))
            return
        name = f"session_{listed.name[:8]}.jsonl"
        context.send(name, encode_journal(recorded.header, recorded.entries))
        context.say("good", context.t("sessions.exported", name=name))

    def _take(self, file: Upload) -> None:
        context = self._context

        def use(recorded: Recorded) -> None:
            if context.shelf.person is not None and any(
                isinstance(e.action, Begin) for e in recorded.entries
            ):
                raise InputError(context.t("sessions.holds_exercise"))  # its score would be nobody's own
            self._must_have_room()
            name = context.shelf.store.take(recorded)
            context.shelf.owners.give(name, context.shelf.owner, Path(file.name).stem)
            self._fill(name)
            context.say("good", context.t("sessions.taken", name=file.name))

        arms = context.shelf.arms.addresses(context.shelf.owner)
        take_small(context, file, _LARGEST, partial(replayable, arms=arms), use)

    def _must_have_room(self) -> None:
        """Raises InputError where the person keeps as much as one person may."""
        if self._context.shelf.full():
            raise InputError(self._context.t("sessions.no_room"))

    def _play(self) -> None:
        context = self._context
        context.drive.must_not_be_stopped()
        recorded = context.shelf.store.recorded(self._chosen.name)
        context.drive.cancel()
        context.drive.errand = context.t("errand.replay")
        self._stop_button.visible = True
        context.stage.handle.visible = False  # nobody drags a replay

        def told(number: int, clock: str, tag: str, state: SessionState) -> None:
            words = context.t("sessions.step", number=number, all=len(recorded.entries), time=clock)
            action = context.t(f"sessions.do_{tag}")
            points = context.t("sessions.then", points=len(state.captures), steps=len(state.steps))
            self._told.content = html.instruction(f"{words}: {action}", points, testid="replayed")

        def steps() -> Iterator[None]:
            yield from played(context, recorded, told)
            self._stop()

        context.worker.animate(_MOTION, steps())
        context.on_page()

    def _stop(self) -> None:
        """The replay ends; the arm stands where this session has it."""
        context = self._context
        context.worker.halt(_MOTION)
        context.drive.errand = ""
        self._stop_button.visible = False
        context.stage.handle.visible = context.stage.show_handle
        back(context)
        context.on_page()

    def refresh(self, state: SessionState) -> None:
        """The list is made anew when it is asked for."""

    def close(self) -> None:
        """The page goes: a replay ends."""
        self._context.worker.halt(_MOTION)


class _Sessions:
    key, order = "sessions", 80

    def build(self, context: Context) -> _View:
        """Makes the widgets."""
        return _View(context)


SCREEN = _Sessions()
