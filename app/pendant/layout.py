"""Where things stand on the page: a panel left for the arm, one right for the screens, lines above and below."""

from __future__ import annotations

import viser

from app.pendant import html

LEFT_PX, RIGHT_PX = 302, 372
BRAND = (214, 96, 20)
_TOP = "rgba(33,37,41,.93)"
_BOTTOM = {
    "info": "rgba(33,37,41,.86)",
    "good": "rgba(35,110,54,.95)",
    "warning": "rgba(166,92,0,.96)",
    "error": "rgba(176,32,32,.96)",
}


class Layout:
    """The frame of one browser's page.

    Args:
        gui: the browser's GUI.
        dark: dark page or light.
    """

    def __init__(self, gui: viser.GuiApi, *, dark: bool):
        self._gui = gui
        self.theme(dark)
        self.left = gui.add_panel(order=1.0)
        self.left.dock_left()
        self.left.set_width(LEFT_PX - 2)
        gui.main_panel.dock_right()
        gui.main_panel.set_width(RIGHT_PX - 2)
        gui.set_panel_label("Teachframe")
        self._status = gui.add_html("", order=-2.0)
        self._message = gui.add_html("", order=-1.0)

    def theme(self, dark: bool) -> None:
        """Dark or light; never a button that opens a tunnel to the outside."""
        self._gui.configure_theme(
            dark_mode=dark,
            show_logo=False,
            show_share_button=False,
            brand_color=BRAND,
            control_width="medium",
        )

    def status(self, items: str) -> None:
        """The line above the cell; `items` from html.item."""
        self._status.content = html.bar(
            items, testid="status", top=True, left=LEFT_PX, right=RIGHT_PX, colour=_TOP
        )

    def message(self, level: str, text: str) -> None:
        """The line below the cell."""
        self._message.content = html.bar(
            html.item(text, testid=f"message-{level}", gives=True),
            testid="message",
            top=False,
            left=LEFT_PX,
            right=RIGHT_PX,
            colour=_BOTTOM[level],
        )
