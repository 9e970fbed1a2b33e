"""One thing on a panel, as the page receives it."""

from __future__ import annotations

from typing import Literal

import msgspec

Kind = Literal[
    "screen", "strip", "folder", "dialog", "html", "button", "buttons", "choice", "check", "number", "slider",
    "text", "vector", "upload", "progress", "rows",
]  # fmt: skip
#: How loud a button is: the one thing to do next, one of several, something set apart.
Rank = Literal["main", "plain", "quiet"]
Value = None | bool | float | str | tuple[float, ...]


class Row(msgspec.Struct, frozen=True, omit_defaults=True):
    """One row of a list, with buttons of its own.

    Args:
        key: names the row in what is heard.
        title: what it is called.
        state: `now`, `done` or `open`.
        light: colour of its lamp; empty for none.
        note: a few words on it.
        actions: (key, label) of its buttons.
    """

    key: str
    title: str
    state: Literal["now", "done", "open"] = "open"
    light: str = ""
    note: str = ""
    actions: tuple[tuple[str, str], ...] = ()


class Widget(msgspec.Struct, kw_only=True, omit_defaults=True):
    """What the page draws.

    Args:
        id: its number; parents stand before children.
        kind: what it is.
        parent: number of what it stands in; 0 for the page.
        order: place among its siblings, small first.
        key: name of a screen.
        label, hint: words on it, words on what it does.
        visible, disabled: as they say.
        rank: of a button.
        value: what stands in it.
        options: of a choice, or labels of a row of buttons.
        low, high, step: of a number.
        content: markup that is safe already.
        accept: kinds of files an upload takes; `several` lets a person drop many or a folder.
        expanded: whether a folder is open at first.
        rows: of a list.
    """

    id: int
    kind: Kind
    parent: int = 0
    order: float = 0.0
    key: str = ""
    label: str = ""
    hint: str = ""
    visible: bool = True
    disabled: bool = False
    rank: Rank = "main"
    value: Value = None
    options: tuple[str, ...] = ()
    low: float | None = None
    high: float | None = None
    step: float | None = None
    content: str = ""
    accept: str = ""
    several: bool = False
    expanded: bool = True
    rows: tuple[Row, ...] = ()
