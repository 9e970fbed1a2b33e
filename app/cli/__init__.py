"""The command line: one file a command under `commands/`.

A command file holds a dataclass `Command` whose fields are the arguments, whose docstring is the help, and
whose `run()` gives the exit code: 0 done, 2 bad input (one line on stderr), 1 an internal fault.
Results go to stdout, progress to stderr. Heavy imports stand inside `run`, so that `--help` is quick.
"""

from __future__ import annotations

import ast
import contextlib
import importlib
import inspect
import io
import os
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import tyro

from app import __version__, catalog
from app.errors import TeachframeError, one_line

COMMANDS = "app.cli.commands"
#: C0 and C1 but tab and line ends, the marks that turn the direction of writing, and halves of letters.
_CONTROL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")


class _Plain:
    """Standard output without control characters: titles and notes of a file may hold what moves a terminal."""

    def __init__(self, stream: Any):
        self._stream = stream

    def write(self, text: str) -> int:
        return self._stream.write(
            text if text.isprintable() else _CONTROL.sub("\N{REPLACEMENT CHARACTER}", text)
        )

    def flush(self) -> None:
        self._stream.flush()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


def run(argv: Sequence[str]) -> int:
    """Runs a command line; never raises for a user's mistake."""
    names = [name.replace("_", "-") for name in catalog.module_names(COMMANDS)]
    if argv and argv[0] == "--version":
        print(f"teachframe {__version__}")
        return 0
    if not argv or argv[0] in ("-h", "--help"):
        print(_overview(names))
        return 0 if argv else 2
    if argv[0] not in names:
        print(f"teachframe: no command {argv[0]!r}; expected one of {', '.join(names)}", file=sys.stderr)
        return 2
    odd = next((word for word in argv if not _is_text(word)), None)
    if odd is not None:
        print(
            f"teachframe {argv[0]}: {one_line(odd, 120)!r} is not UTF-8; expected a name that is",
            file=sys.stderr,
        )
        return 2
    try:
        module = importlib.import_module(f"{COMMANDS}.{argv[0].replace('-', '_')}")
        command = _parsed(module.Command, f"teachframe {argv[0]}", argv[1:])
        with contextlib.redirect_stdout(_Plain(sys.stdout)):
            return int(command.run() or 0)
    except SystemExit as stop:  # tyro's own: --help, or arguments that do not fit
        return stop.code if isinstance(stop.code, int) else 2
    except TeachframeError as error:
        print(f"teachframe {argv[0]}: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:  # the disk, not the program: no space, a name too long, no right
        if os.environ.get("TEACHFRAME_DEBUG"):
            raise
        where = f"{one_line(str(error.filename), 120)}: " if error.filename else ""
        print(f"teachframe {argv[0]}: {where}{error.strerror or type(error).__name__}", file=sys.stderr)
        return 2
    except Exception as error:
        if os.environ.get("TEACHFRAME_DEBUG"):
            raise
        what = one_line(f"{type(error).__name__}: {error}", 200)
        print(
            f"teachframe {argv[0]}: internal fault ({what}); TEACHFRAME_DEBUG=1 shows the trace",
            file=sys.stderr,
        )
        return 1


def _is_text(word: str) -> bool:
    """False for bytes of a file's name that stand for no letters: no report could speak of it."""
    try:
        word.encode()
    except UnicodeEncodeError:
        return False
    return True


def _parsed(command: type, prog: str, argv: Sequence[str]) -> Any:
    """The command with its arguments. Arguments that do not fit give one line, not tyro's framed page."""
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said):
            return tyro.cli(
                command, args=list(argv), prog=prog, description=inspect.cleandoc(command.__doc__ or "")
            )
    except SystemExit as stop:
        if stop.code not in (0, None):
            frame = str.maketrans("", "", "╭╮╰╯│─")
            lines = [line.translate(frame).strip(" |") for line in said.getvalue().splitlines()]
            said_lines = [line for line in lines[1:] if line.strip("+-")] or ["the arguments do not fit"]
            what = " ".join(said_lines[: 2 if said_lines[0].endswith(":") else 1])
            print(one_line(f"{prog}: {what}; `{prog} --help` shows what there is"), file=sys.stderr)
        raise


def _overview(names: list[str]) -> str:
    lines = [
        f"teachframe {__version__}: a teach pendant in the browser, and what a simulation left out.",
        "",
        "usage: teachframe COMMAND [ARGUMENTS]      teachframe COMMAND --help",
        "",
    ]
    folder = Path(__file__).parent / "commands"
    width = max(map(len, names))
    lines += [f"  {name:<{width}} {_first_line(folder / (name.replace('-', '_') + '.py'))}" for name in names]
    return "\n".join(lines)


def _first_line(path: Path) -> str:
    """A command's first docstring line, read without importing it."""
    text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    return text.partition("\n")[0]
