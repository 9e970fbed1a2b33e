"""Rows of a recording as a recording of their own, beside copies of its descriptions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Whole:
    """A recording by its lines.

    Args:
        comments: what its file begins with.
        heads: the line of column names.
        rows: one line each.
    """

    path: Path
    comments: list[str]
    heads: str
    rows: list[str]

    @classmethod
    def of(cls, path: Path) -> Whole:
        lines = path.read_text(encoding="utf-8").splitlines()
        heads, *rows = [line for line in lines if not line.startswith("#")]
        return cls(path, [line for line in lines if line.startswith("#")], heads, rows)

    def between(self, begin: float, end: float) -> list[str]:
        """The rows between two shares of it."""
        return self.rows[int(begin * len(self.rows)) : int(end * len(self.rows))]

    def part(self, rows: Sequence[str], into: Path) -> Path:
        """Some rows as a file, its descriptions copied beside it."""
        for description in self.path.parent.glob("*.urdf"):
            (into.parent / description.name).write_bytes(description.read_bytes())
        into.write_text("\n".join([*self.comments, self.heads, *rows]) + "\n", encoding="utf-8")
        return into
