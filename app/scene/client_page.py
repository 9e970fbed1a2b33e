"""viser's client as one page: everything of its own panels hidden, what a frame needs added."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import viser

#: Panels, notifications, dialogs, search and figures of viser's own.
_STYLE = (
    ".mantine-Paper-root,.mantine-Notifications-root,.mantine-Modal-root,.mantine-Spotlight-root,[data-portal],"
    "[data-floating-window],[data-dock-root]>:not(:first-child),.stats-panel{display:none!important}"
)
# viser reconnects only while its own frame has the focus; ours is beside it. Where software draws (the page says so by
# a fixed resolution) the canvas would take all of the thread it shares with the held switch: it leaves pauses.
_SCRIPT = """
Document.prototype.hasFocus = () => true;
if (new URLSearchParams(location.search).has("fixedDpr")) {
  const PAUSE = 80, next = window.requestAnimationFrame.bind(window);
  let free = 0;
  const run = (draw) => (now) => { draw(now); free = performance.now() + PAUSE; };
  window.requestAnimationFrame = (draw) => {
    const wait = free - performance.now();
    return wait > 4 ? setTimeout(() => next(run(draw)), wait) : next(run(draw));
  };
  const stop = window.cancelAnimationFrame.bind(window);
  window.cancelAnimationFrame = (number) => { clearTimeout(number); stop(number); };
}
"""


@cache
def client_page() -> bytes:
    """The page; raises RuntimeError where viser is not the version this was made for."""
    path = Path(viser.__file__).parent / "client" / "build" / "index.html"
    text = path.read_text(encoding="utf-8")
    if "</head>" not in text:
        raise RuntimeError("viser's client is not what it was: no head to add to")
    return text.replace("</head>", f"<style>{_STYLE}</style><script>{_SCRIPT}</script></head>", 1).encode()
