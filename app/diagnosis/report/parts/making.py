"""How the page was made, and what its words mean."""

from __future__ import annotations

from html import escape

from app import __version__
from app.diagnosis.wording import WORDS
from app.phrases import FALLBACK

_WORDS = ("before_after", "held_out", "certainty", "visible", "std", "delta_bic")


def reading(language: str = FALLBACK) -> str:
    """A short glossary."""

    def t(key: str) -> str:
        return escape(WORDS.text(f"page.{key}", language))

    rows = "".join(f"<dt>{t(f'glossary.{word}')}</dt><dd>{t(f'meaning.{word}')}</dd>" for word in _WORDS)
    return (
        f'<section><h2>{t("title.reading")}</h2><dl class="small" style="display:grid;'
        f'grid-template-columns:max-content 1fr;gap:2px 14px;margin:0">{rows}</dl></section>'
    )


def making(command: str, seed: int, seconds: float, date: str, language: str = FALLBACK) -> str:
    """Command, version, seed and date."""
    made = WORDS.text(
        "page.made", language, version=__version__, date=date, seconds=f"{seconds:.2f}", seed=seed
    )
    return f"<footer>{escape(made)}<br><code>{escape(command)}</code></footer>"
