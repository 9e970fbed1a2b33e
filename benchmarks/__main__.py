"""Runs the benchmarks and prints one table, with the machine and the versions it was measured on."""

from __future__ import annotations

import importlib
import math
import os
import platform
import sys
import time
import traceback
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before numpy is imported; one thread for both sides
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

FOLDER = Path(__file__).parent
NOT_SUBJECTS = {"__init__", "__main__", "rows"}
PACKAGES = ("teachframe", "numpy", "scipy", "pin", "polars", "viser", "figaroh", "scikit-surgerycalibration")


def subjects() -> list[str]:
    """Names of the files that can be run."""
    return sorted(
        p.stem for p in FOLDER.glob("*.py") if p.stem not in NOT_SUBJECTS and not p.stem.startswith("_")
    )


def chosen(names: Sequence[str], available: Sequence[str]) -> list[str]:
    """Those named, or all; a part of a name serves ("static" runs every static_*).

    Raises:
        SystemExit: a name that fits nothing.
    """
    if not names:
        return list(available)
    found = []
    for name in names:
        fits = [a for a in available if a == name] or [a for a in available if a.startswith(name)]
        if not fits:
            raise SystemExit(f"benchmarks: nothing called {name!r}; there are {', '.join(available)}")
        found += [f for f in fits if f not in found]
    return found


def figure(value: Any, unit: str) -> str:
    """A number with its unit, seconds in the unit that suits them."""
    if value is None or not math.isfinite(value):
        return "-"
    if unit == "s":
        for limit, scale, name in ((1e-3, 1e6, "us"), (1.0, 1e3, "ms")):
            if abs(value) < limit:
                return f"{value * scale:.3g} {name}"
    return f"{value:.3g} {unit}"


def line(row: Any) -> tuple[str, ...]:
    """The cells of one row; rows of any class with these attributes serve."""
    unit = getattr(row, "unit", "s")
    peer, aim = getattr(row, "peer", None), getattr(row, "aim", None)
    known = peer is not None and math.isfinite(peer) and row.ours > 0
    times = f"{peer / row.ours:.3g}x" if known else "-"
    met = "" if aim is None else (" met" if row.ours <= aim else " MISSED")
    return (
        row.name,
        figure(row.ours, unit),
        figure(aim, unit) + met if aim is not None else "-",
        figure(peer, unit),
        times,
        getattr(row, "peer_name", "") or "",
    )


HEADS = ("benchmark", "ours", "aim", "peer", "peer/ours", "peer is")


def table(lines: Sequence[Sequence[str]]) -> str:
    """Columns as wide as they need to be, numbers on the right."""
    widths = [max(len(HEADS[i]), *(len(cells[i]) for cells in lines)) for i in range(len(HEADS))]

    def said(cells: Sequence[str]) -> str:
        ends = (0, len(HEADS) - 1)
        return "  ".join(
            cell.ljust(w) if i in ends else cell.rjust(w)
            for i, (cell, w) in enumerate(zip(cells, widths, strict=True))
        ).rstrip()

    return "\n".join([said(HEADS), "  ".join("-" * w for w in widths), *map(said, lines)])


def machine() -> str:
    """What it was measured on."""
    cpu = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        names = [
            part.partition(":")[2].strip() for part in info.read_text().splitlines() if "model name" in part
        ]
        cpu = names[0] if names else cpu
    versions = []
    for name in PACKAGES:
        try:
            versions.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            versions.append(f"{name} not installed")
    return (
        f"{cpu}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}; {platform.system()}, "
        f"Python {platform.python_version()}\n{', '.join(versions)}"
    )


def main(names: Sequence[str]) -> int:
    """Runs them one after the other; one that fails is named and stops no other.

    A file with a `command` of its own takes what follows its name, as in `real_static FILE... --write`.
    """
    if len(names) > 1 and names[0] in subjects() and not set(names[1:]) & set(subjects()):
        own = getattr(importlib.import_module(f"benchmarks.{names[0]}"), "command", None)
        if own is not None:
            return own(names[1:])
    print(machine() + "\n", flush=True)
    failed = []
    lines: list[tuple[str, ...]] = []
    for name in chosen(names, subjects()):
        start = time.perf_counter()
        try:
            run = getattr(importlib.import_module(f"benchmarks.{name}"), "run", None)
            if run is None:
                continue
            lines += [line(row) for row in run()]
        except Exception:
            traceback.print_exc()
            failed.append(name)
        print(f"{name}: {time.perf_counter() - start:.1f} s", file=sys.stderr, flush=True)
    if lines:
        print(table(lines))
    for name in failed:
        print(f"FAILED: {name}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
