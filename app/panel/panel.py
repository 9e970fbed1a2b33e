"""The tree of widgets of one session: who hears what somebody does, and what changed since when."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from markupsafe import escape

from app.panel.meant import meant
from app.panel.standing_out import Place, keys, ranked, speaking
from app.panel.uploads import Upload
from app.panel.widgets import Kind, Rank, Row, Widget

_CONTAINERS = ("screen", "strip", "folder", "dialog")


def _field(name: str) -> Any:
    def read(handle: Handle) -> Any:
        return getattr(handle.data, name)

    def write(handle: Handle, value: Any) -> None:
        handle.panel.set(handle.data, name, value)

    return property(read, write, doc=f"The widget's `{name}`; the page follows.")


class Handle:
    """A widget in the program's hands.

    Attributes:
        heard: called with what somebody entered or pressed; on the server's thread, so it must only enqueue.
    """

    label, hint, visible, disabled = _field("label"), _field("hint"), _field("visible"), _field("disabled")
    value, options, content, order = _field("value"), _field("options"), _field("content"), _field("order")
    min, max, rows, rank = _field("low"), _field("high"), _field("rows"), _field("rank")

    def __init__(self, panel: Panel, data: Widget):
        self.panel, self.data = panel, data
        self.heard: Callable[[Any], object] | None = None

    def remove(self) -> None:
        """Takes it away, with everything in it."""
        self.panel.remove(self.data.id)

    close = remove

    def __enter__(self) -> Handle:
        self.panel.inside.append(self.data.id)
        return self

    def __exit__(self, *_: object) -> None:
        self.panel.inside.pop()


class Panel:
    """All widgets of one session. Screens make them on their worker's thread; the page reads from any other."""

    def __init__(self):
        self._lock = threading.RLock()
        self._handles: dict[int, Handle] = {}
        self._changed: dict[int, int] = {}
        self._removed: dict[int, int] = {}
        self._speaking: Place = (0, 0)
        self._weighed = 0  # the revision it was looked up at
        self._number = self.revision = 0
        self.inside: list[int] = []  # where the next widget is put
        self.news: Callable[[], None] = lambda: None

    # Reading ----------------------------------------------------------------------------------------------

    def since(self, revision: int) -> tuple[int, list[Widget], list[int]]:
        """The revision now, widgets that changed after the one given, and numbers of those taken away."""
        with self._lock:
            widgets = {number: handle.data for number, handle in self._handles.items()}
            self._speak(widgets)
            changed = [self._handles[n].data for n, at in self._changed.items() if at > revision]
            removed = [n for n, at in self._removed.items() if at > revision]
            copies = [ranked(data, widgets, self._speaking) for data in sorted(changed, key=lambda d: d.id)]
            return self.revision, copies, removed if revision else []

    def widgets(self) -> list[Widget]:
        """All of them, parents before children."""
        return self.since(0)[1]

    def find(self, label: str, kind: str = "") -> Handle:
        """The newest visible widget of this label, for tests; raises KeyError."""
        with self._lock:
            for handle in reversed(list(self._handles.values())):
                if handle.data.label == label and kind in ("", handle.data.kind) and self.seen(handle.data):
                    return handle
        raise KeyError(label)

    def seen(self, data: Widget) -> bool:
        """True where neither the widget nor what it stands in is hidden."""
        while data.visible and data.parent:
            data = self._handles[data.parent].data
        return data.visible

    # Hearing ----------------------------------------------------------------------------------------------

    def hear(self, number: int, value: Any) -> None:
        """What somebody did with a widget; what cannot be meant is passed over."""
        with self._lock:
            handle = self._handles.get(number)
            if handle is None or handle.data.disabled or not self.seen(handle.data):
                return
            ok, value = meant(handle.data, value)
            if not ok:
                return
            if handle.data.kind in ("choice", "check", "number", "slider", "text", "vector"):
                self.set(handle.data, "value", value)
            heard = handle.heard
        if heard is not None:
            heard(value)

    def takes_files(self, number: int) -> bool:
        """True where files may be sent to this widget now."""
        with self._lock:
            handle = self._handles.get(number)
            return handle is not None and handle.data.kind == "upload" and self.seen(handle.data)

    def hear_files(self, number: int, files: Sequence[Upload], done: Callable[[], None]) -> None:
        """Files somebody sent; `done` is called when they are no longer needed."""
        handle = self._handles.get(number)
        if handle is None or handle.heard is None:
            done()
            return
        handle.heard((tuple(files), done))

    # Changing ---------------------------------------------------------------------------------------------

    def set(self, data: Widget, name: str, value: Any) -> None:
        """Another value of one field; as content only markup is taken as markup, anything else is escaped."""
        value = str(escape(value)) if name == "content" else value
        with self._lock:
            if getattr(data, name) != value or type(getattr(data, name)) is not type(value):
                setattr(data, name, value)
                if data.id in self._handles:
                    self._touch(data.id)

    def remove(self, number: int) -> None:
        """Takes a widget away, with everything in it."""
        with self._lock:
            if number not in self._handles:
                return
            for child in [n for n, handle in self._handles.items() if handle.data.parent == number]:
                self.remove(child)
            del self._handles[number]
            self._changed.pop(number, None)
            self.revision += 1
            self._removed[number] = self.revision
            self.news()

    def reset(self) -> None:
        """Takes everything away."""
        with self._lock:
            for number in [n for n, handle in self._handles.items() if not handle.data.parent]:
                self.remove(number)
            self.inside.clear()

    def _speak(self, widgets: Mapping[int, Widget]) -> None:
        """Another place may have the key that is pressed next: all keys of the first rank are told anew then.

        Looked up where a page asks what changed, and not at every change: a screen changes many widgets at once.
        """
        if self._weighed != self.revision and (place := speaking(widgets, self.seen)) != self._speaking:
            self._speaking = place
            for number in keys(widgets):
                self._touch(number)
        self._weighed = self.revision

    def _touch(self, number: int) -> None:
        self.revision += 1
        self._changed[number] = self.revision
        self.news()

    def _add(self, kind: Kind, label: str = "", **fields: Any) -> Handle:
        with self._lock:
            self._number += 1
            order = fields.pop("order", None)
            data = Widget(
                id=self._number,
                kind=kind,
                label=label,
                parent=self.inside[-1] if self.inside else 0,
                order=float(self._number if order is None else order),
                **fields,
            )
            handle = self._handles[self._number] = Handle(self, data)
            self._touch(self._number)
            return handle

    # Making -----------------------------------------------------------------------------------------------

    def add_screen(self, key: str, label: str) -> Handle:
        """A tab."""
        return self._add("screen", label, key=key)

    def add_strip(self) -> Handle:
        """What stands above all tabs: the task of an exercise."""
        return self._add("strip", visible=False)

    def add_dialog(self, label: str) -> Handle:
        """What stands over the page until it is closed."""
        return self._add("dialog", label)

    def add_folder(self, label: str, *, visible: bool = True, expanded: bool = True) -> Handle:
        """A part with a title that can be folded."""
        return self._add("folder", label, visible=visible, expanded=expanded)

    def add_html(self, content: str = "", *, visible: bool = True) -> Handle:
        """Text with structure, from app.panel.markup; anything else is escaped."""
        return self._add("html", content=str(escape(content)), visible=visible)

    def add_button(self, label: str, *, hint: str = "", rank: Rank = "main", visible: bool = True) -> Handle:
        """A button."""
        return self._add("button", label, hint=hint, rank=rank, visible=visible)

    def add_buttons(
        self,
        label: str,
        options: tuple[str, ...],
        *,
        hint: str = "",
        visible: bool = True,
        rank: Rank = "plain",
    ) -> Handle:
        """A row of buttons; which one was pressed is heard by its label. The first one has the rank."""
        return self._add("buttons", label, options=options, hint=hint, visible=visible, rank=rank)

    def add_choice(
        self, label: str, options: tuple[str, ...], *, value: str | None = None, visible: bool = True
    ) -> Handle:
        """One of several."""
        chosen = options[0] if value is None else value
        return self._add("choice", label, options=options, value=chosen, visible=visible)

    def add_check(self, label: str, value: bool, *, hint: str = "", visible: bool = True) -> Handle:
        """Yes or no."""
        return self._add("check", label, value=value, hint=hint, visible=visible)

    def add_number(
        self,
        label: str,
        value: float,
        *,
        low: float | None = None,
        high: float | None = None,
        step: float | None = None,
        visible: bool = True,
    ) -> Handle:
        """A number somebody types."""
        return self._add("number", label, value=value, low=low, high=high, step=step, visible=visible)

    def add_slider(
        self, label: str, low: float, high: float, step: float, value: float, *, visible: bool = True
    ) -> Handle:
        """A number somebody drags."""
        return self._add("slider", label, low=low, high=high, step=step, value=value, visible=visible)

    def add_text(self, label: str, value: str, *, hint: str = "", visible: bool = True) -> Handle:
        """A line somebody types."""
        return self._add("text", label, value=value, hint=hint, visible=visible)

    def add_vector(self, label: str, value: tuple[float, ...], *, step: float = 0.1) -> Handle:
        """A few numbers that belong together."""
        return self._add("vector", label, value=value, step=step)

    def add_upload(self, label: str, *, hint: str = "", accept: str = "", several: bool = False) -> Handle:
        """A place to drop files."""
        return self._add("upload", label, hint=hint, accept=accept, several=several, rank="plain")

    def add_progress(self, *, visible: bool = True) -> Handle:
        """A bar from 0 to 100."""
        return self._add("progress", value=0.0, visible=visible)

    def add_rows(self, rows: tuple[Row, ...] = (), *, visible: bool = True) -> Handle:
        """A list whose rows have buttons; heard as `row/action`."""
        return self._add("rows", rows=rows, visible=visible)
