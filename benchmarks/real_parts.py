"""Small parts of real recordings: learnt there, carried to the rest of the same recording.

    python -m benchmarks real_parts                        twelve to 120 rows of every touch and tracker recording
    python -m benchmarks real_parts --seed 7 --write       other parts; writes its section of docs/real_recordings.md

A part is spread over the recording, or one stretch of it (touches: whole targets), so that the rest lies between its
poses or beyond them. The peer is the best of the ordinary calibrations of the same rows, chosen by hindsight.
"""

from __future__ import annotations

import argparse
import math
import random
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from app.units import mm
from benchmarks._calibration.peer import calibrate, carried
from benchmarks._document import DOCS, markdown, replace_section
from benchmarks._parting import Whole
from benchmarks._program import judged, learn
from benchmarks.real_static import recordings
from benchmarks.rows import Row

SIZES = (12, 20, 35, 60, 120)
MOST_JUDGED = 400  # rows of the rest
LARGEST = 0.7  # of a recording: a part that is larger leaves too little to be judged
POOR_MM = 5.0  # of a recording whose ordinary calibrations leave more, something else is wrong


@dataclass(frozen=True)
class Part:
    """Error of one axis on the rest of a recording [mm].

    Args:
        ours: by the program's saved model.
        peer: of the best ordinary calibration.
    """

    recording: str
    rows: int
    how: str
    ours: float
    peer: float

    @property
    def ratio(self) -> float:
        return self.ours / self.peer


def parts(seed: int) -> Iterator[Part]:
    """Two parts of each size of every recording, as soon as they are measured."""
    draw = random.Random(seed)
    for path in (p for arm in recordings(()) for p in arm):
        for size in SIZES:
            for how in ("spread", "stretch"):
                yield from _part(path, size, how, draw)


def _part(path: Path, size: int, how: str, draw: random.Random) -> Iterator[Part]:
    whole = Whole.of(path)
    if size >= LARGEST * len(whole.rows):
        return
    learnt, rest = _divided(whole.heads.split(","), whole.rows, size, how, draw)
    with tempfile.TemporaryDirectory() as folder:
        first = whole.part(learnt, Path(folder) / "learnt.csv")
        second = whole.part(rest, Path(folder) / "rest.csv")
        try:
            there, aside = carried(calibrate([first]), second)
        except ValueError:  # not one row is near any arm of this kind
            return
        peer = min(float(mm(e.heldout)) for e in there.values())
        ours = judged(learn([first]), second, aside)
    if peer < POOR_MM:
        yield Part(f"{path.parent.name}/{path.stem}", size, how, ours, peer)


def _divided(
    heads: list[str], body: list[str], size: int, how: str, draw: random.Random
) -> tuple[list[str], list[str]]:
    """The rows of a part, and those of the rest that it is judged on."""
    if "target" in heads:
        column, targets = heads.index("target"), {}
        for row in body:
            targets.setdefault(row.split(",")[column], []).append(row)
        names = list(targets)
        if how == "spread":
            draw.shuffle(names)
        learnt: list[str] = []
        while len(learnt) < size:
            learnt += targets[names.pop(0)]
        return learnt, [row for name in names for row in targets[name]][:MOST_JUDGED]
    if how == "spread":
        order = draw.sample(range(len(body)), len(body))
        own, others = sorted(order[:size]), sorted(order[size : size + MOST_JUDGED])
    else:
        start = draw.randrange(len(body) - size)
        own = list(range(start, start + size))
        left = [k for k in range(len(body)) if not start <= k < start + size]
        others = sorted(draw.sample(left, min(len(left), MOST_JUDGED)))
    return [body[k] for k in own], [body[k] for k in others]


class Rated(Protocol):
    """A part and its error over the peer's."""

    @property
    def recording(self) -> str: ...

    @property
    def ratio(self) -> float: ...


def summary(found: Sequence[Rated]) -> list[tuple[str, ...]]:
    """A line a recording and one of all: how many parts, the mean ratio, the largest, how many are worse by 5%."""
    names = [*dict.fromkeys(p.recording for p in found), "all"]
    out = []
    for name in names:
        ratios = [p.ratio for p in found if name in ("all", p.recording)]
        mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
        worse = sum(ratio > 1.05 for ratio in ratios)
        out.append((name, str(len(ratios)), f"{mean:.2f}", f"{max(ratios):.2f}", str(worse)))
    return out


HEADS = ("recording", "parts", "error over least squares', geometric mean", "largest", "worse by 5%")


def section(found: Sequence[Part], seed: int) -> str:
    """The document's section."""
    command = f"python -m benchmarks real_parts --seed {seed} --write"
    how = f"{min(SIZES)} to {max(SIZES)} rows of a recording, spread over it or one stretch, learnt alone and"
    return (
        f"## Parts of recordings\n\nBy `{command}`: {how}\n"
        "carried to the rest, base and tool (or touched points) fitted there. The peer is the best of the ordinary\n"
        "calibrations of the same rows, chosen by hindsight.\n\n" + markdown(HEADS, summary(found))
    )


def run() -> list[Row]:
    """The mean ratio of all parts."""
    found = list(parts(1))
    ratio = float(summary(found)[-1][2])
    return [
        Row(f"{len(found)} parts of recordings carried to the rest", ratio, 1.0, "best least squares", "")
    ]


def command(arguments: Sequence[str]) -> int:
    """Every part, then the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks real_parts", description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="which parts")
    parser.add_argument("--write", action="store_true", help="write the section of docs/real_recordings.md")
    chosen = parser.parse_args(arguments)
    found = []
    for part in parts(chosen.seed):
        print(
            f"{part.ratio:6.3f}  {part.recording} {part.rows} rows, {part.how}: {part.ours:.4f} / {part.peer:.4f} mm",
            flush=True,
        )
        found.append(part)
    print(markdown(HEADS, summary(found)))
    if chosen.write:
        replace_section(DOCS / "real_recordings.md", "parts", section(found, chosen.seed))
    return 0
