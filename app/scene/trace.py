"""The way of the true tip while the tool turns about the point that was found, drawn larger than it is."""

from __future__ import annotations

import numpy as np
import viser

from app.calibration.verify import Verification
from app.scene.exaggeration import factor_for
from app.units import from_mm, mm

_LARGEST = from_mm(100.0)  # the farthest that trace and sphere may be drawn from where it starts
#: Turns about the tool's X, Y and Z.
_COLOURS = np.array([(214, 48, 49), (46, 139, 87), (42, 98, 184)], np.uint8)
_GREY = (120, 130, 140)


def trace_factor(found: Verification) -> int:
    """How many times larger than it is the trace is drawn."""
    reach = max(found.wander, found.expected if np.isfinite(found.expected) else 0.0)
    return factor_for(max(reach, 1e-9), _LARGEST)


class Trace:
    """The trace, and the sphere that it was predicted to stay in."""

    def __init__(self, scene: viser.SceneApi):
        self._scene = scene
        self._fixed: list[viser.SceneNodeHandle] = []
        self._line: viser.SceneNodeHandle | None = None

    def show(self, found: Verification | None, until: int | None = None) -> None:
        """Draws the trace up to a pose of the turn (None: all of it), or takes it away."""
        self._clear()
        if found is None or len(found.trace) < 2:
            return
        factor, start = trace_factor(found), found.trace[0]
        if np.isfinite(found.expected):
            self._fixed.append(
                self._scene.add_icosphere(
                    "/trace/predicted",
                    factor * found.expected,
                    _GREY,
                    position=tuple(start),
                    opacity=0.12,
                    cast_shadow=False,
                    receive_shadow=False,
                )
            )
        count = len(found.trace) if until is None else min(until + 1, len(found.trace))
        drawn = start + factor * (found.trace[:count] - start)
        if count > 1:
            colours = _COLOURS[found.axes[1:count]]
            self._line = self._scene.add_line_segments(
                "/trace/line",
                np.stack([drawn[:-1], drawn[1:]], axis=1).astype(np.float32),
                np.repeat(colours[:, None], 2, axis=1),
                thickness=6.0,
                thickness_units="screen",
            )
        if until is None:
            away = int(np.argmax(np.linalg.norm(found.trace - start, axis=1)))
            self._fixed.append(
                self._scene.add_label(
                    "/trace/label",
                    f"{mm(found.wander):.2f} mm ×{factor}",
                    position=tuple(drawn[away]),
                    font_screen_scale=0.8,
                    anchor="center-left",
                )
            )

    @property
    def drawn(self) -> bool:
        """True while there is a trace."""
        return self._line is not None

    def _clear(self) -> None:
        for handle in (*self._fixed, *([self._line] if self._line is not None else [])):
            handle.remove()
        self._fixed, self._line = [], None
