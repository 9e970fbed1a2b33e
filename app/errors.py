"""Every error this program raises on purpose.

TeachframeError
├── InputError                    what was given cannot be used (exit code 2)
│   ├── FileFormatError           not a file of this kind at all
│   ├── MissingColumnError        a column or key that is needed is not there
│   ├── UnitError                 a quantity without, or with an unknown, unit
│   ├── CellValueError            one cell holds something else than what was expected
│   └── UnknownNameError          a name that is not in a catalogue; lists what is
├── DegenerateGeometryError       the points cannot determine what is asked (exit code 2)
│   └── TooFewPointsError         fewer points than unknowns need
├── StorageError                  the database did not keep or give what was asked
│   └── ConflictError             another program wrote the same row first
├── ActionRefusedError            a session's state does not allow the action
└── PersonRefusedError            somebody is not known here, or may not do this (exit code 2)

Each carries its evidence as attributes and says itself in one line, `str(error)`.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from pathlib import Path
from typing import Any


class TeachframeError(Exception):
    """The root: everything below is for a person to read and act on."""

    def __reduce__(self) -> tuple[Any, ...]:
        """An error of a process of its own reaches its parent with all it carries."""
        return _again, (type(self), self.args, self.__dict__)


def _again(kind: type[TeachframeError], args: tuple[Any, ...], carried: dict[str, Any]) -> TeachframeError:
    error = kind.__new__(kind, *args)
    error.args = args
    error.__dict__.update(carried)
    return error


class InputError(TeachframeError):
    """Input that cannot be used: which file, row and column, what was found and what was expected.

    Args:
        problem: what is wrong, in a few words.
        file: the file it stands in, where there is one.
        row: line number in that file, counted from 1 as an editor does.
        column: the column or key.
        expected: what would have been right.
    """

    def __init__(
        self,
        problem: str,
        *,
        file: str | Path | None = None,
        row: int | None = None,
        column: str | None = None,
        expected: str | None = None,
    ):
        self.problem, self.file, self.row, self.column, self.expected = problem, file, row, column, expected
        place = [
            *([str(file)] if file is not None else []),
            *([f"row {row}"] if row is not None else []),
            *([f"column {column}"] if column is not None else []),
        ]
        text = (", ".join(place) + ": " if place else "") + problem
        super().__init__(one_line(text + (f"; expected {expected}" if expected else "")))


class FileFormatError(InputError):
    """Not a file of the kind that was asked for."""


class MissingColumnError(InputError):
    """A needed column or header key is absent."""


class UnitError(InputError):
    """A quantity came without a unit, or with one that is not known."""


class CellValueError(InputError):
    """One cell holds something else than what was expected."""


class UnknownNameError(InputError):
    """A name that no catalogue holds. Lists what is available and the nearest spelling."""

    def __init__(
        self,
        name: str,
        *,
        available: Iterable[str],
        what: str = "name",
        file: str | Path | None = None,
        row: int | None = None,
        column: str | None = None,
    ):
        self.name, self.available = name, sorted(available)
        near = difflib.get_close_matches(name, self.available, n=1)
        hint = f" (did you mean {near[0]}?)" if near else ""
        super().__init__(
            f"unknown {what} {name!r}{hint}",
            file=file,
            row=row,
            column=column,
            expected="one of " + ", ".join(self.available),
        )


class DegenerateGeometryError(TeachframeError):
    """The points given cannot determine what is asked of them.

    Args:
        message: what cannot be determined and why.
        rank: directions that are determined.
        needed: directions that must be.
        unseen: the direction or quantity nothing was learnt about.
        advice: what to do next.
        said: the whole sentence as a phrase that speaks other languages too, where there is one.
    """

    def __init__(
        self,
        message: str,
        *,
        rank: int | None = None,
        needed: int | None = None,
        unseen: str | None = None,
        advice: str | None = None,
        code: str = "degenerate",
        file: str | Path | None = None,
        said: object = None,
    ):
        self.rank, self.needed, self.unseen, self.advice, self.code = rank, needed, unseen, advice, code
        self.message, self.file, self.said = message, file, said
        where = f"{file}: " if file is not None else ""
        super().__init__(one_line(where + message + (f"; {advice}" if advice else "")))

    def in_file(self, file: str | Path) -> DegenerateGeometryError:
        """The same error, naming the file the points came from."""
        return type(self)(
            self.message,
            rank=self.rank,
            needed=self.needed,
            unseen=self.unseen,
            advice=self.advice,
            code=self.code,
            file=file,
            said=self.said,
        )


class TooFewPointsError(DegenerateGeometryError):
    """Fewer points than the unknowns need."""


class StorageError(TeachframeError):
    """The database did not keep or give what was asked; nothing was changed."""


class ConflictError(StorageError):
    """Another program wrote the same row first; nothing was changed."""


class ActionRefusedError(TeachframeError):
    """The session is not in a state that allows this action; says what to do instead.

    Args:
        message: why, in one sentence.
        said: the same as a phrase that speaks other languages too, where there is one.
    """

    def __init__(self, message: str, *, said: object = None):
        self.said = said
        super().__init__(message)


class PersonRefusedError(TeachframeError):
    """Somebody is not let in, or may not do this.

    Args:
        why: a code, for whoever reacts to it.
        message: why, in one sentence.
        said: the same as a phrase that speaks other languages too.
    """

    def __init__(self, why: str, message: str, *, said: object = None):
        self.why, self.said = why, said
        super().__init__(one_line(message))


def one_line(text: str, limit: int = 600) -> str:
    """Folds control characters and length away: an error is one line, whatever was in the file."""
    clean = text if text.isprintable() else "".join(c if c.isprintable() else " " for c in text)
    return clean if len(clean) <= limit else clean[: limit - 1] + "…"
