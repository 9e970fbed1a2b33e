"""What a fleet's summary is said in: `words/en.toml` and its translations."""

from __future__ import annotations

from pathlib import Path

from app.phrases import Texts

WORDS = Texts(Path(__file__).parent / "words")
