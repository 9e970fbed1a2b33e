"""Templates of pages, sheets and reports: Jinja2 with autoescape, so that no text of a file or a person is markup."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from app.figures import finished


@cache
def templates(beside: str, *, forms: bool = False) -> Environment:
    """The folder `templates` beside a module; a text that a template asks for and is not given is a fault.

    Args:
        beside: the module's `__file__`.
        forms: what is put in comes back from fields and stays as it was typed; else figures are put as they are read.
    """
    return Environment(
        finalize=None if forms else finished,
        loader=FileSystemLoader(Path(beside).parent / "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
