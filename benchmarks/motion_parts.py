"""Parts of real joint logs: learnt there, carried to the rest of the same log.

    python -m benchmarks motion_parts                      a twelfth to a half of every joint log
    python -m benchmarks motion_parts --seed 7 --write     other parts; writes its section of docs/real_recordings.md

A part is one stretch of time; it is judged on all that comes after it or before it, whichever is longer. The peers are
plain least squares of _ordinary.py on the same windows, with the rotors' inertia or without it, chosen by hindsight,
and the description as it is.
"""

from __future__ import annotations

import argparse
import random
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec

from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.dynamic.judging import judged
from app.diagnosis.model import SavedModel
from app.errors import InputError
from benchmarks._document import DOCS, markdown, replace_section
from benchmarks._parting import Whole
from benchmarks.ordinary_motion import carried, folders, read
from benchmarks.real_parts import HEADS, summary
from benchmarks.rows import Row

SHARES = (0.08, 0.15, 0.3, 0.5)  # of a log
GAP = 0.01  # of it, between what is learnt and what is judged


@dataclass(frozen=True)
class Part:
    """Torque error on the rest of a log [Nm].

    Args:
        ours: by the program's saved model.
        peer: by the better of the two least squares.
        described: by the description as it is.
    """

    recording: str
    share: float
    ours: float
    peer: float
    described: float

    @property
    def ratio(self) -> float:
        return self.ours / self.peer


def parts(seed: int, each: int) -> Iterator[Part]:
    """So many parts of every log, as soon as they are measured."""
    draw = random.Random(seed)
    for path in (p for folder in folders([]) for p in sorted(folder.glob("run_*.csv"))):
        for _ in range(each):
            share = draw.choice(SHARES)
            begin = draw.uniform(0.0, 1.0 - share)
            try:
                yield part(path, begin, begin + share)
            except InputError as error:  # a stretch in which nothing moves
                print(f"        {path.parent.name}/{path.stem} {begin:.3f} to {begin + share:.3f}: {error}")


def part(path: Path, begin: float, end: float) -> Part:
    """A log learnt between two shares of its rows, and carried to the longer side of the rest."""
    after = begin <= 1.0 - end
    whole = Whole.of(path)
    beyond = whole.between(end + GAP, 1.0) if after else whole.between(0.0, begin - GAP)
    with tempfile.TemporaryDirectory() as folder:
        here = read(whole.part(whole.between(begin, end), Path(folder) / "part.csv"))
        rest = read(whole.part(beyond, Path(folder) / "rest.csv"))
        model = msgspec.convert(dict(diagnose(here.table, here.robot).model), SavedModel)
        before, ours = judged(rest.table, rest.robot, model).qualities
    name = f"{path.parent.name}/{path.stem}"
    return Part(name, end - begin, ours.fit_rms, carried(here, rest), before.fit_rms)


def section(found: Sequence[Part], arguments: str) -> str:
    """The document's section."""
    beyond = sum(p.ours > 1.05 * p.described for p in found)
    command = f"python -m benchmarks motion_parts {arguments}--write"
    return (
        f"## Parts of joint logs\n\nBy `{command}`: a twelfth to a half of a log,\n"
        "one stretch of time, learnt alone and carried to what comes after it or before it. The peer is plain least "
        "squares on\nthe same windows, with the rotors' inertia or without it, chosen by hindsight.\n"
        f"{beyond} of {len(found)} parts carry worse by 5% than the description as it is.\n\n"
        + markdown(HEADS, summary(found))
    )


def run() -> list[Row]:
    """The mean ratio of all parts."""
    found = list(parts(1, 1))
    ratio = float(summary(found)[-1][2])
    return [Row(f"{len(found)} parts of joint logs carried to the rest", ratio, 1.0, "least squares", "")]


def command(arguments: Sequence[str]) -> int:
    """Every part, then the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks motion_parts", description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="which parts")
    parser.add_argument("--each", type=int, default=4, help="parts of a log")
    parser.add_argument("--write", action="store_true", help="write the section of docs/real_recordings.md")
    chosen = parser.parse_args(arguments)
    found = []
    for one in parts(chosen.seed, chosen.each):
        print(
            f"{one.ratio:6.3f}  {one.recording} {one.share:.0%}: {one.ours:.4g}, least squares {one.peer:.4g}, "
            f"description {one.described:.4g} Nm",
            flush=True,
        )
        found.append(one)
    print(markdown(HEADS, summary(found)))
    if chosen.write:
        wanted = "".join(f"--{name} {getattr(chosen, name)} " for name in ("seed", "each"))
        replace_section(DOCS / "real_recordings.md", "motion_parts", section(found, wanted))
    return 0
