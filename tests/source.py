"""The program's own source as syntax trees, for tests that look at how it is written."""

import ast
from functools import cache
from pathlib import Path


@cache
def parsed(path: Path) -> ast.Module:
    """The tree of a file, parsed once.

    CPython 3.11 counts the depth of a tree in one place for all threads (its issue 106905): a thread that an earlier
    test left behind, compiling something meanwhile, ends a parse with a SystemError that says nothing of the file. A
    second try is not disturbed; a file that cannot be parsed fails it as well, with a SyntaxError.
    """
    text = path.read_text(encoding="utf-8")
    try:
        return ast.parse(text)
    except SystemError:
        return ast.parse(text)
