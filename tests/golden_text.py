"""Texts that a person reads, held word for word. `make golden` rewrites them after a change that is meant."""

import os
from pathlib import Path

FOLDER = Path(__file__).parent / "golden"


def assert_golden(name: str, text: str) -> None:
    """Compares `text` with tests/golden/<name>; under TEACHFRAME_REWRITE_GOLDEN=1 it is written instead.

    Tests that call this have `golden` in their name, so that `-k golden` finds them all.
    """
    path = FOLDER / name
    if os.environ.get("TEACHFRAME_REWRITE_GOLDEN"):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    assert path.is_file(), f"{path} is missing; write it with `make golden` and read what it says"
    assert text == path.read_text(encoding="utf-8"), (
        f"differs from {path}; if meant, `make golden` rewrites it"
    )
