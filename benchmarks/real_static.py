"""Real static recordings: an ordinary calibration by least squares and the diagnosis, here and on another run.

    python -m benchmarks real_static                       every touch and tracker recording of the data folder
    python -m benchmarks real_static FILE...               these alone
    python -m benchmarks real_static --peer                the ordinary calibration alone
    python -m benchmarks real_static --write               and writes its section of docs/real_recordings.md

Files of one folder that name one robot are runs of one arm: each is learnt alone, of three or more also all but one
and all together, and every model is judged on each run that it has not seen. Data folder: $TEACHFRAME_DATA.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator, Sequence
from itertools import combinations
from pathlib import Path

from app.recordings import read_table
from app.units import mm
from benchmarks._calibration.fit import Errors
from benchmarks._calibration.peer import Calibrated, calibrate, carried
from benchmarks._document import DOCS, replace_section
from benchmarks._program import Learnt, judged, learn
from benchmarks._real_table import Line, Other, section, summary
from benchmarks.rows import Row


def data_folder() -> Path:
    """Where the recordings are."""
    return Path(os.environ.get("TEACHFRAME_DATA", Path(__file__).parents[2] / "shared" / "data"))


def recordings(named: Sequence[str]) -> list[list[Path]]:
    """Files of touches and tracker points, those of one arm together.

    Args:
        named: paths; none means all of the data folder.
    """
    paths = [Path(name) for name in named] or sorted(data_folder().glob("*/*.csv"))
    arms: dict[Path, list[Path]] = {}
    for path in paths:
        table = read_table(path)
        if table.kind in ("touch", "tracker"):
            arms.setdefault((path.parent / str(table.keys["robot"])).resolve(), []).append(path)
    if not arms:
        raise SystemExit(
            f"benchmarks: no touch or tracker recordings in {data_folder()}; TEACHFRAME_DATA names another"
        )
    return list(arms.values())


def learning_sets(runs: Sequence[Path]) -> list[tuple[Path, ...]]:
    """Each run alone; of three or more also all but one, and all."""
    alone = [(run,) for run in runs]
    return alone if len(runs) < 3 else [*alone, *combinations(runs, len(runs) - 1), tuple(runs)]


def lines(arms: Sequence[Sequence[Path]], *, program: bool = True) -> Iterator[Line]:
    """One line a learning set, as soon as it is measured."""
    for runs in arms:
        for files in learning_sets(runs):
            peer = calibrate(files)
            ours = learn(files) if program else None
            others = tuple(_carried(peer, ours, run) for run in runs if run not in files)
            yield Line(files, peer, ours, others)


def _carried(peer: Calibrated, ours: Learnt | None, run: Path) -> Other:
    there, aside = carried(peer, run)
    return Other(run, there, aside, None if ours is None else judged(ours, run, aside))


def run() -> list[Row]:
    """Held-out error of the diagnosis beside the best ordinary calibration of the same file and of the run not seen."""
    rows = []
    for line in lines(recordings(())):
        name = "+".join(p.stem for p in line.files)
        where = f"{line.files[0].parent.name} {name}"
        if line.ours is None:
            continue
        best = min(line.peer.here.values(), key=lambda e: e.heldout)
        rows.append(_row(f"{where}, held out", line.ours.after, best))
        for other in line.others:
            if other.ours is not None:
                least = min(other.there.values(), key=lambda e: e.heldout)
                rows.append(_row(f"{where} carried to {other.path.stem}", other.ours, least))
    return rows


def _row(name: str, ours: float, peer: Errors) -> Row:
    """Millimetres of one axis."""
    return Row(name, ours, float(mm(peer.heldout)), "least squares, geometry and elasticity", "mm")


def command(arguments: Sequence[str]) -> int:
    """The table on its own, with the options of the heading."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks real_static", description=__doc__)
    parser.add_argument("files", nargs="*", help="recordings; all of the data folder where none is named")
    parser.add_argument("--peer", action="store_true", help="the ordinary calibration alone")
    parser.add_argument("--write", action="store_true", help="write the section of docs/real_recordings.md")
    chosen = parser.parse_args(arguments)
    done = []
    for line in lines(recordings(chosen.files), program=not chosen.peer):
        print(summary(line), flush=True)
        done.append(line)
    if chosen.write:
        replace_section(DOCS / "real_recordings.md", "static", section(done))
    return 0


if __name__ == "__main__":
    import sys

    sys.exit(command(sys.argv[1:]))
