"""The tools that a file lists, and the one that is meant.

Every format gives all tools it finds, in the order of the file. The bare flange is passed over where another tool
stands there; of several, one has to be chosen by its name or number. Nothing is guessed.
"""

from __future__ import annotations

import bisect
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol

from app.calibration.exchange._frame import ToolFrame
from app.errors import FileFormatError, UnknownNameError

#: Tools named in a refusal; a longer list helps nobody.
_SHOWN = 20


@dataclass(frozen=True)
class Tool:
    """One tool of a file, not yet worked out: numbers that cannot be used matter only where this one is meant.

    Args:
        name: as the file writes it; "" where the format has no names.
        number: the controller's own number; 0 where it has none, then its place in the list counts.
        row: line in the file.
        written: its numbers as they stand there, to tell one tool that is set twice from two.
        bare: True where these numbers are those of the flange itself.
        make: its frame; raises FileFormatError where the numbers cannot be used.
        predefined: the controller's own name of the bare flange (tool0, NULLFRAME): never a tool.
    """

    name: str
    number: int
    row: int
    written: str | tuple[str, ...]
    bare: bool
    make: Callable[[], ToolFrame]
    predefined: bool = False


class ExchangeFormat(Protocol):
    """A file under exchange/ with an object `FORMAT` of this shape is a format."""

    key: str
    title: str
    suffix: str
    #: Endings of files that this kind of controller writes, with or without a tool in them.
    suffixes: tuple[str, ...]
    #: What a file without a tool lacks, and what would have been one.
    lacks: str
    absent: str

    def knows(self, text: str) -> bool:
        """True where `text` looks like this format."""
        ...

    def write(self, frame: ToolFrame) -> str:
        """The frame as text."""
        ...

    def tools(self, text: str) -> list[Tool]:
        """Every tool in `text`, in order, in a time that grows with its length and no faster.

        Raises:
            FileFormatError: the text cannot be read at all.
        """
        ...

    def read(self, text: str, tool: str | None = None) -> ToolFrame:
        """The tool meant.

        Raises:
            FileFormatError: there is none, several and none is named, or its numbers cannot be used.
            UnknownNameError: none of this name or number.
        """
        ...


class Reader:
    """`read` for every format that gives its `tools`."""

    lacks: str
    absent: str

    def tools(self, text: str) -> list[Tool]:
        raise NotImplementedError

    def read(self, text: str, tool: str | None = None) -> ToolFrame:
        found = self.tools(text)
        if not found:
            raise FileFormatError(f"no tool frame in this file: {self.lacks}", row=1, expected=self.absent)
        return (_only(found) if tool is None else _named(found, tool)).make()


class Rows:
    """Line number of a place in a text, from 1."""

    def __init__(self, text: str):
        self._ends = [i for i, c in enumerate(text) if c == "\n"]

    def __call__(self, place: int) -> int:
        return bisect.bisect_left(self._ends, place) + 1


def _only(tools: Sequence[Tool]) -> Tool:
    """The one tool that is no bare flange; raises where that cannot be told."""
    real = [tool for tool in tools if not tool.predefined and not tool.bare]
    different = _different(real)
    if len(different) == 1:
        return different[0]
    if not real:
        own = [tool for tool in tools if not tool.predefined]
        if len(own) == 1:  # a tool that was taught at the flange itself
            return own[0]
        raise FileFormatError(
            "no tool frame in this file, only the bare flange", row=tools[0].row, expected="a tool"
        )
    raise FileFormatError(
        f"{len(different)} tools in this file: {_list(tools, different)}",
        row=different[0].row,
        expected="--tool NAME or --tool NUMBER",
    )


def _named(tools: Sequence[Tool], wanted: str) -> Tool:
    """The tool of a name, else of a number."""
    found = _different([tool for tool in tools if tool.name.lower() == wanted.strip().lower() and tool.name])
    if not found and wanted.strip().isdecimal() and len(wanted) < 10:
        found = [tool for place, tool in enumerate(tools, 1) if (tool.number or place) == int(wanted)][:1]
    if len(found) == 1:
        return found[0]
    if found:
        raise FileFormatError(
            f"{len(found)} tools are called {wanted!r}: {_list(tools, found)}",
            row=found[0].row,
            expected="--tool NUMBER",
        )
    labels = [_label(tools, tool) for tool in tools[:_SHOWN]]
    raise UnknownNameError(wanted[:40], available=labels, what="tool")


def _label(tools: Sequence[Tool], tool: Tool) -> str:
    number = tool.number or next(i for i, other in enumerate(tools, 1) if other is tool)
    return f"{number} {tool.name}".strip()


def _list(tools: Sequence[Tool], shown: Sequence[Tool]) -> str:
    more = f" and {len(shown) - _SHOWN} more" if len(shown) > _SHOWN else ""
    return ", ".join(_label(tools, tool) for tool in shown[:_SHOWN]) + more


def _different(tools: Sequence[Tool]) -> list[Tool]:
    """Tools that are set again under the same name with the same numbers count once."""
    kept: dict[tuple[object, ...], Tool] = {}
    for tool in tools:
        kept.setdefault((tool.name, tool.number, tool.written), tool)
    return list(kept.values())


def all_zero(numbers: Iterable[str]) -> bool:
    """True where every number is zero, however it is written; one that is none counts as something."""
    return not any(set(text.partition("e")[0].partition("E")[0]) & set("123456789") for text in numbers)
