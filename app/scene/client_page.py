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
  // Numbers of its own: a timer's may be that of a frame, and to give up the one would give up the other for good.
  const PAUSE = 80, next = window.requestAnimationFrame.bind(window), stop = window.cancelAnimationFrame.bind(window);
  const waiting = new Map(), late = new Map();  // what is late goes on together and in its order
  const goOn = () => { const asks = [...late.values()]; late.clear(); asks.forEach((ask) => ask()); };
  let free = 0, last = 1e9;
  window.requestAnimationFrame = (draw) => {
    const number = ++last, wait = free - performance.now();
    const run = (now) => { waiting.delete(number); draw(now); free = performance.now() + PAUSE; };
    const ask = () => { const frame = next(run); waiting.set(number, () => stop(frame)); };
    if (!late.size && wait <= 4) { ask(); return number; }
    if (!late.size) setTimeout(goOn, wait);
    late.set(number, ask);
    waiting.set(number, () => late.delete(number));
    return number;
  };
  window.cancelAnimationFrame = (number) => { waiting.get(number)?.(); waiting.delete(number); };
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
