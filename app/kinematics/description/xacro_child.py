"""Expands one xacro file to stdout: `python xacro_child.py FILE FOLDER`. Runs alone, see xacro.py.

Nothing of the program is imported here: this process evaluates what a stranger wrote.
"""

from __future__ import annotations

import resource
import sys
from pathlib import Path

_MEMORY = 900_000_000  # bytes of address space, of which Python and its libraries take a third
_SECONDS = 3  # of the processor, after the libraries are read; a whole humanoid takes one
_REFUSED = (
    "subprocess.",
    "os.system",
    "os.exec",
    "os.fork",
    "os.spawn",
    "os.posix_spawn",
    "socket.",
    "ctypes.",
)
_CHANGES = ("os.remove", "os.rename", "os.mkdir", "os.rmdir", "os.chmod", "os.link", "os.symlink", "shutil.")

_refused: list[str] = []


def main(file: str, folder: str) -> None:
    """Prints the expanded description."""
    import xacrodoc

    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    used = resource.getrusage(resource.RUSAGE_SELF)
    most = int(used.ru_utime + used.ru_stime) + 1 + _SECONDS
    resource.setrlimit(resource.RLIMIT_CPU, (most, most))
    packages = {p.parent.name: str(p.parent) for p in sorted(Path(folder).glob("*/package.xml"))}
    xacrodoc.packages.update_package_cache(packages)
    _confine(folder)
    text = xacrodoc.XacroDoc.from_file(file, walk_up=False, resolve_packages=False).to_urdf_string(
        use_protocols=False
    )
    sys.stdout.write(text)


def _confine(folder: str) -> None:
    """From here on only files of `folder` and of Python itself can be read, and nothing can be written or started."""
    allowed = [str(Path(p).resolve()) for p in (folder, sys.prefix, sys.base_prefix, "/usr/lib/python3")]

    def look(event: str, arguments: tuple) -> None:
        if event == "open":
            name, mode = str(arguments[0]), arguments[1]
            place = str(Path(name).resolve()) if isinstance(arguments[0], str | bytes | Path) else ""
            inside = any(place == root or place.startswith(root + "/") for root in allowed)
            if place and not inside:
                refuse(f"reads {name}, outside {folder}")
            if mode and any(letter in str(mode) for letter in "wax+"):
                refuse(f"writes {name}")
        elif event.startswith((*_REFUSED, *_CHANGES)):
            refuse(f"asks for {event}")

    def refuse(what: str) -> None:
        _refused.append(what)  # xacro puts words of its own around an error
        raise PermissionError(what)

    sys.addaudithook(look)


if __name__ == "__main__":
    try:
        main(sys.argv[1], sys.argv[2])
    except BaseException as error:
        told = _refused[0] if _refused else str(error) or type(error).__name__
        print(told.splitlines()[0], file=sys.stderr)
        raise SystemExit(2) from None
