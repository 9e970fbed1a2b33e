"""Prints a list: a table for people, a JSON object a line for programs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from app.cli.accounts.base import table

T = TypeVar("T")


def show(
    found: Sequence[T],
    titles: tuple[str, ...],
    row: Callable[[T], tuple[str, ...]],
    *,
    nothing: str,
    json: bool,
) -> None:
    """Prints what was found.

    Args:
        found: a data class each.
        titles: of the table's columns.
        row: the cells of one of them.
        nothing: what is said where there are none.
        json: one JSON object each instead of the table.
    """
    import msgspec

    if json:
        for one in found:
            print(msgspec.json.encode(one).decode())
    else:
        print(table([titles, *map(row, found)]) if found else nothing)
