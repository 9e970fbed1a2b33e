"""What a pendant may ask of the server about all sessions: list them, open another one, keep scores."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from app.session import Store
from app.training.records import Records


@dataclass(frozen=True)
class Shelf:
    """The sessions of this server.

    Args:
        store: where they are kept.
        records: scores of exercises.
        in_use: True where another browser has this session open.
        switch: hands a browser, by its number, another session; returns at once.
    """

    store: Store
    records: Records
    in_use: Callable[[str], bool]
    switch: Callable[[int, str], None]
