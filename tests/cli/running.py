"""Runs a command as a user does, in this process, and gives what it said."""

import contextlib
import io
from dataclasses import dataclass

from app.cli import run


@dataclass(frozen=True)
class Said:
    """Exit code, stdout and stderr."""

    code: int
    out: str
    err: str


def teachframe(*argv) -> Said:
    """`teachframe argv...` without a new process."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = run([str(a) for a in argv])
    return Said(code, out.getvalue(), err.getvalue())


def assert_one_line(said: Said, *words: str) -> None:
    """Bad input: exit 2, nothing on stdout, one line on stderr that holds these words."""
    assert said.code == 2, said
    assert said.out == ""
    lines = said.err.splitlines()
    assert len(lines) == 1, said.err
    assert "Traceback" not in said.err
    for word in words:
        assert word in lines[0], said.err
