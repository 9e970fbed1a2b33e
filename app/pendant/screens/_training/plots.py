"""The history from try to try."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from app.training.score import ScoreCard

if TYPE_CHECKING:
    import plotly.graph_objects as go

    from app.pendant.client import Pendant

#: Height of the plot over its width, and no buttons on it.
ASPECT, PLAIN = 0.62, {"displayModeBar": False}
_SCORE, _ERROR, _RESIDUAL = "#2f9e44", "#d66014", "#868e96"


def history(pendant: Pendant, cards: Sequence[ScoreCard], goal: str) -> go.Figure:
    """Score, and error beside what the residual made one believe, over the tries.

    Args:
        cards: of one exercise, the oldest first.
        goal: of that exercise: which error is shown.
    """
    import plotly.graph_objects as go

    t = pendant.t
    done = [card for card in cards if not card.given_up]
    tries = list(range(1, len(done) + 1))
    error = {"touch": "touch_mm", "tool": "tool_mm", "relation": "meeting_mm"}[goal]
    shown = {"tool": "residual_mm", "relation": "predicted_mm"}.get(goal, "")
    figure = go.Figure()
    figure.add_scatter(
        x=tries,
        y=[card.total for card in done],
        name=t("training.plot_score"),
        mode="lines+markers",
        line_color=_SCORE,
    )
    for name, colour, dash in ((error, _ERROR, "solid"), (shown, _RESIDUAL, "dot")):
        if name:
            figure.add_scatter(
                x=tries,
                y=[card.figures.get(name) for card in done],
                name=t(f"training.plot_{name}"),
                mode="lines+markers",
                line={"color": colour, "dash": dash},
                yaxis="y2",
            )
    ink = "#c1c2c5" if pendant.dark else "#343a40"
    grid = "rgba(128,128,128,.25)"
    figure.update_layout(
        margin={"l": 38, "r": 38, "t": 8, "b": 34},
        font={"size": 11, "color": ink},
        paper_bgcolor="rgba(0,0,0,0)",
        plot_bgcolor="rgba(0,0,0,0)",
        legend={"orientation": "h", "y": 1.0, "yanchor": "bottom", "x": 0.0},
        xaxis={
            "title": t("training.plot_try"),
            "dtick": max(1, len(done) // 8),
            "gridcolor": grid,
            "zeroline": False,
        },
        yaxis={"range": [0, 105], "gridcolor": grid, "zeroline": False},
        yaxis2={
            "overlaying": "y",
            "side": "right",
            "rangemode": "tozero",
            "title": "mm",
            "showgrid": False,
            "tickmode": "auto",
            "nticks": 5,
        },
    )
    return figure
