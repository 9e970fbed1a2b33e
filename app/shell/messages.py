"""What page and server say to each other. Both sides know VERSION; a page of another version is reloaded."""

from __future__ import annotations

from typing import Any, Literal

import msgspec

from app.panel import Widget
from app.typed import learnt
from app.workers.readout import Read

VERSION = 1


class _In(msgspec.Struct, frozen=True, tag_field="t", forbid_unknown_fields=True):
    """From the page."""


class Beat(_In, frozen=True, tag="beat"):
    """Which buttons are held: the enabling switch; one pair's button by axis and sign; the number of its press."""

    en: bool
    axis: int | None = None
    sign: int = 0
    press: int = 0


class Stop(_In, frozen=True, tag="stop"):
    """Emergency stop."""


class Release(_In, frozen=True, tag="release"):
    """Releases the emergency stop."""


class Cancel(_In, frozen=True, tag="cancel"):
    """Gives up a motion that waits or runs."""


class Home(_In, frozen=True, tag="home"):
    """The arm goes home."""


class Joint(_In, frozen=True, tag="joint"):
    """A joint goes to a typed value, degrees or millimetres."""

    axis: int
    value: float


class Choose(_In, frozen=True, tag="choose"):
    """Frame, increment, override, language, dark, view, handle, window: width and height of the scene's [px]."""

    what: str
    value: bool | float | str


class Press(_In, frozen=True, tag="press"):
    """Something was done with a widget."""

    id: int
    value: bool | float | str | list[float] | None = None


class Hinted(_In, frozen=True, tag="hint"):
    """The page shows a hint; away: it was put away."""

    id: int
    away: bool = False


class Ping(_In, frozen=True, tag="ping"):
    """Asks for an answer, to measure the way."""

    n: float


In = Beat | Stop | Release | Cancel | Home | Joint | Choose | Press | Hinted | Ping


class _Out(msgspec.Struct, frozen=True, tag_field="t"):
    """To the page."""


class Hello(_Out, frozen=True, tag="hello"):
    """What can be chosen, the page's texts, who is logged in, and his page beside the pendant: his lessons, or the
    classes he trains; said anew when the language changes."""

    version: int
    choices: dict[str, Any]
    texts: dict[str, str]
    person: str = ""
    beside: Literal["", "lessons", "classes"] = ""


class Panel(_Out, frozen=True, tag="panel"):
    """Widgets that changed and numbers of those taken away; `whole` where these are all there are."""

    widgets: list[Widget]
    removed: list[int]
    whole: bool


class File(_Out, frozen=True, tag="file"):
    """A file to fetch."""

    token: str
    name: str


class Taken(_Out, frozen=True, tag="taken"):
    """Another page shows the session now."""


class Pong(_Out, frozen=True, tag="pong"):
    """The answer."""

    n: float


Out = Hello | Panel | File | Taken | Pong | Read

_DECODER = learnt(In)


def heard(text: str | bytes) -> In:
    """A message of the page; raises msgspec.DecodeError."""
    return _DECODER.decode(text)


def said(message: Out) -> str:
    """A message to the page."""
    return msgspec.json.encode(message).decode()
