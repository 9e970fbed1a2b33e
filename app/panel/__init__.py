"""What stands on a pendant's panels, as plain data: no browser, no web server.

    widgets.py    Widget: one thing on a panel, as the page receives it
    panel.py      Panel: the tree of them, who hears what somebody does, and what changed since when
    meant.py      what a page says of a widget, looked at before anybody hears it
    standing_out.py  which keys of the first rank stand out: those of one place at a time
    uploads.py    a file somebody sent
    markup.py     small pieces of text with structure: tables, lights, notes; everything escaped

A screen makes widgets and sets their values; the page draws whatever is there. So what a person sees can be asked for
as JSON, and a test needs no browser.
"""

from app.panel.panel import Handle, Panel
from app.panel.uploads import Upload
from app.panel.widgets import Row, Widget

__all__ = ["Handle", "Panel", "Row", "Upload", "Widget"]
