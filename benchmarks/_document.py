"""Sections of a document that a command writes: what stands between two marks is replaced, the rest stays."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

DOCS = Path(__file__).parents[1] / "docs"


def replace_section(path: Path, name: str, text: str) -> None:
    """Writes `text` between the marks of `name`, at the end of the document where it has none yet."""
    first, last = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    body = path.read_text(encoding="utf-8") if path.exists() else ""
    section = f"{first}\n{text.strip()}\n{last}"
    before, found, rest = body.partition(first)
    if found:
        body = before + section + rest.partition(last)[2]
    else:
        body = f"{body.rstrip()}\n\n{section}\n".lstrip()
    path.parent.mkdir(exist_ok=True)
    path.write_text(body, encoding="utf-8")


def markdown(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table; a bar in a cell does not end it."""
    said = [[cell.replace("|", "\\|").replace("\n", " ") for cell in row] for row in rows]
    lines = [heads, ["---"] * len(heads), *said]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
