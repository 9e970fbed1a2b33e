"""The history from try to try."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from app.panel.markup import Markup, escape
from app.training.score import ScoreCard

if TYPE_CHECKING:
    from app.screens.context import Context

_WIDTH, _HEIGHT, _EDGE = 320.0, 170.0, 26.0  # px of the picture, and of the room for its figures
_FULL = 100.0  # points


def history(context: Context, cards: Sequence[ScoreCard], goal: str) -> str:
    """Score, and error beside what the residual made one believe, over the tries, as a picture.

    Args:
        cards: of one exercise, the oldest first.
        goal: of that exercise: which error is shown.
    """
    t = context.t
    done = [card for card in cards if not card.given_up]
    error = {"touch": "touch_mm", "tool": "tool_mm", "relation": "meeting_mm"}[goal]
    shown = {"tool": "residual_mm", "relation": "promised_mm"}.get(goal, "")
    errors = {name: [card.figures.get(name) for card in done] for name in (error, shown) if name}
    most = max((v for values in errors.values() for v in values if v is not None), default=1.0) or 1.0
    lines = [("score", t("training.plot_score"), [card.total for card in done], _FULL)]
    lines += [
        ("error" if name == error else "believed", t(f"training.plot_{name}"), values, most)
        for name, values in errors.items()
    ]
    drawn = "".join(_line(look, values, top) for look, _, values, top in lines)
    keys = "".join(f'<span class="{look}">{escape(title)}</span>' for look, title, _, _ in lines)
    floor = _HEIGHT - _EDGE
    frame = (
        f'<line x1="{_EDGE}" y1="{floor}" x2="{_WIDTH - _EDGE}" y2="{floor}"/>'
        f'<text x="2" y="{_EDGE + 4}">100</text><text x="2" y="{floor}">0</text>'
        f'<text x="{_WIDTH - _EDGE + 3}" y="{_EDGE + 4}">{most:.1f}</text>'
        f'<text x="{_WIDTH - _EDGE + 3}" y="{floor}">mm</text>'
        f'<text x="{_WIDTH / 2}" y="{_HEIGHT - 6}" text-anchor="middle">{escape(t("training.plot_try"))}</text>'
    )
    return Markup(  # numbers, and texts escaped above
        f'<figure class="history" data-testid="history"><svg viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" '
        f'aria-label="{escape(t("training.history"))}">{frame}{drawn}</svg><figcaption>{keys}</figcaption></figure>'
    )


def _line(look: str, values: Sequence[float | None], top: float) -> str:
    """A line through the tries that have the figure, with a dot at each."""
    room = _WIDTH - 2 * _EDGE
    points = [
        (
            _EDGE + room * (k / max(len(values) - 1, 1)),
            _HEIGHT - _EDGE - (_HEIGHT - 2 * _EDGE) * min(value / top, 1.0),
        )
        for k, value in enumerate(values)
        if value is not None
    ]
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    dots = "".join(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3"/>' for x, y in points)
    return f'<g class="{look}"><polyline points="{path}"/>{dots}</g>'
