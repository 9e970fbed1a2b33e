"""Which of the keys of the first rank stand out: those of one place at a time, so that one key is pressed next.

Each screen says which of its own keys is next, and so does the task of an exercise above it and a dialog over both. To
a person they are one page: where two of them have such a key, the one that is over the other speaks.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import msgspec

from app.panel.widgets import Widget

#: Of the places that a page shows at once, from what lies below to what lies over it.
_LAYERS = {"screen": 0, "strip": 1, "dialog": 2}
_KEYS = ("button", "buttons")
Place = tuple[int, int]  # the layer, and among dialogs the number of the one: the newest lies over the others


def speaking(widgets: Mapping[int, Widget], seen: Callable[[Widget], bool]) -> Place:
    """The uppermost place that shows an enabled key of the first rank; a screen where none does.

    Args:
        widgets: all of them, by number.
        seen: True for one that is shown, with all that it stands in.
    """
    shown = (data for data in widgets.values() if _first(data) and not data.disabled and seen(data))
    return max((_place(data, widgets) for data in shown), default=(0, 0))


def ranked(data: Widget, widgets: Mapping[int, Widget], place: Place) -> Widget:
    """A copy as the page draws it: a key of the first rank below the place that speaks is one of several.

    Args:
        data: the widget.
        widgets: all of them, by number.
        place: that speaks.
    """
    below = _first(data) and _place(data, widgets) < place
    return msgspec.structs.replace(data, rank="plain" if below else data.rank)


def keys(widgets: Mapping[int, Widget]) -> list[int]:
    """Numbers of the keys of the first rank."""
    return [number for number, data in widgets.items() if _first(data)]


def _first(data: Widget) -> bool:
    return data.kind in _KEYS and data.rank == "main"


def _root(data: Widget, widgets: Mapping[int, Widget]) -> Widget:
    """What a widget stands in on the page: a strip and a dialog stand over all screens, whichever made them."""
    while data.parent and data.kind not in _LAYERS:
        data = widgets[data.parent]
    return data


def _place(data: Widget, widgets: Mapping[int, Widget]) -> Place:
    root = _root(data, widgets)
    return _LAYERS.get(root.kind, 0), root.id if root.kind == "dialog" else 0
