"""How the page was made, and what its words mean."""

from __future__ import annotations

from html import escape

from app import __version__

_WORDS = (
    (
        "Before, after",
        "the robot's description as it is, and the same with the effects named here in it; "
        "base, tool and whatever else the recording leaves open are fitted both times.",
    ),
    ("Held out", "rows that the fit did not see; an error that falls there is not fitted noise."),
    (
        "Certainty (p)",
        "chance that the whole search, every effect at every place, would find something as "
        "strong in a recording without it.",
    ),
    (
        "Visible",
        "share of the effect that the fitted base, tool and targets cannot imitate. The smaller, the "
        "less this recording can say about it.",
    ),
    ("± ", "one standard deviation."),
    ("ΔBIC", "how much worse another explanation fits; below about 9 this recording does not rule it out."),
)


def reading() -> str:
    """A short glossary."""
    rows = "".join(f"<dt>{escape(word)}</dt><dd>{escape(meaning)}</dd>" for word, meaning in _WORDS)
    return (
        '<section><h2>How to read this page</h2><dl class="small" style="display:grid;'
        f'grid-template-columns:max-content 1fr;gap:2px 14px;margin:0">{rows}</dl></section>'
    )


def making(command: str, seed: int, seconds: float, date: str) -> str:
    """Command, version, seed and date."""
    return (
        f"<footer>Made by Teachframe {__version__} on {escape(date)} in {seconds:.2f} s of search, seed {seed}. "
        f"The same command on the same file gives the same answer.<br><code>{escape(command)}</code></footer>"
    )
