"""What goes to the page, put as it is read: figures by `app.figures`, wherever the page draws words.

Values of fields and options stay as they are: the page says them back.
"""

from __future__ import annotations

from msgspec.structs import replace

from app.figures import in_markup, together
from app.panel import Row, Widget
from app.workers.readout import Read


def widget(data: Widget) -> Widget:
    """A widget with its words as they are read."""
    return replace(
        data,
        label=together(data.label),
        hint=together(data.hint),
        content=in_markup(data.content),
        rows=tuple(map(_row, data.rows)),
    )


def _row(row: Row) -> Row:
    return replace(row, title=together(row.title), note=together(row.note))


def frame(read: Read) -> Read:
    """The figures and the line of the frame as they are read."""
    return replace(
        read,
        errand=together(read.errand),
        axes=tuple(replace(axis, value=together(axis.value)) for axis in read.axes),
        pose=tuple((name, together(value)) for name, value in read.pose),
        touch=together(read.touch),
        message=together(read.message),
        hinted=together(read.hinted),
    )


def seat(of_person: dict[str, str]) -> dict[str, str]:
    """What somebody of a class does, as it follows on the class's page."""
    return {key: words if key in ("person", "state") else together(words) for key, words in of_person.items()}


def texts(of_page: dict[str, str]) -> dict[str, str]:
    """The page's own words."""
    return {key: together(words) for key, words in of_page.items()}
