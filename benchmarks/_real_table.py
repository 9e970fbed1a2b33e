"""Lines of the comparison on real static recordings, as text and as a section of docs/real_recordings.md."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from app.diagnosis.quantity import quantity
from app.diagnosis.report.budget import budget_sentence, unexplained_sentence
from app.diagnosis.report.wording import effect_title, place
from app.diagnosis.result import Diagnosis
from app.units import mm
from benchmarks._calibration.fit import ELASTIC, GEOMETRY, NOTHING, Errors
from benchmarks._calibration.peer import Calibrated
from benchmarks._document import markdown
from benchmarks._program import Learnt

STAGES = (NOTHING, GEOMETRY, ELASTIC)
#: Findings with their values that a line lists; the rest are counted.
LISTED = 8


@dataclass(frozen=True, eq=False)
class Other:
    """A run that was not learnt from.

    Args:
        there: errors of the ordinary calibration there.
        aside: lines not counted.
        ours: held-out error of the program's model there [mm].
    """

    path: Path
    there: dict[str, Errors]
    aside: tuple[int, ...]
    ours: float | None


@dataclass(frozen=True, eq=False)
class Line:
    """What was learnt from some files."""

    files: tuple[Path, ...]
    peer: Calibrated
    ours: Learnt | None
    others: tuple[Other, ...]

    @property
    def name(self) -> str:
        """Folder and runs."""
        return f"{self.files[0].parent.name} {' + '.join(path.stem for path in self.files)}"

    @property
    def command(self) -> str:
        """How the program's part is made again."""
        files = " ".join(f"{path.parent.name}/{path.name}" for path in self.files)
        return f"teachframe diagnose {files}{' --together' if len(self.files) > 1 else ''}"


def millimetres(value: float | None) -> str:
    """Three digits that count."""
    return "-" if value is None or not math.isfinite(value) else f"{value:.3g}"


def _heldout(errors: dict[str, Errors]) -> list[str]:
    return [millimetres(mm(errors[s].heldout)) if s in errors else "-" for s in STAGES]


def _least(errors: dict[str, Errors]) -> float:
    return float(min(mm(e.heldout) for e in errors.values()))


def _marked(ours: float | None, peer: float) -> str:
    """In bold where the ordinary calibration is better by more than 1%."""
    said = millimetres(ours)
    return f"**{said}**" if ours is not None and ours > 1.01 * peer else said


def summary(line: Line) -> str:
    """One recording in a few lines of text."""
    aside = sum(len(rows) for rows in line.peer.aside)
    out = [f"{line.name}: {line.peer.rows} rows, {aside} set aside; held out [mm an axis]"]
    if line.peer.horizon:
        out.append("    joint 3 is counted against the horizon (told to the ordinary calibration)")
    for what, error in line.peer.here.items():
        out.append(
            f"    {what:<26}{millimetres(mm(error.heldout)):>8}   fitted {millimetres(mm(error.fitted))}"
        )
    if line.ours is not None:
        out += [f"    {said}" for said in _program(line.ours)]
    for other in line.others:
        here = ", ".join(f"{what} {said}" for what, said in zip(STAGES, _heldout(other.there), strict=True))
        ours = "" if other.ours is None else f", program {millimetres(other.ours)}"
        out.append(f"    carried to {other.path.stem}: {here}{ours}")
    seconds = "" if line.ours is None else f", program {line.ours.seconds:.2f} s"
    return "\n".join([*out, f"    least squares {line.peer.seconds:.2f} s{seconds}"])


def _program(ours: Learnt) -> list[str]:
    if ours.found is None:
        return [f"program: {ours.refused}"]
    d = ours.found
    return [
        f"{'program':<26}{millimetres(d.after.heldout_rms):>8}   fitted {millimetres(d.after.fit_rms)}; "
        f"before {millimetres(d.before.heldout_rms)}; {d.verdict}; {len(d.outliers)} set aside",
        *([_budget(d)] if d.families else []),
        *_found(d),
    ]


def _found(d: Diagnosis) -> list[str]:
    listed = []
    for f in d.findings[:LISTED]:
        values = ", ".join(quantity(p, marked=False) for p in f.parameters)
        listed.append(f"{effect_title(f.effect)}, {place(f.where)}: {values}".rstrip(": "))
    more = len(d.findings) - len(listed)
    return [*listed, *([f"and {more} more"] if more > 0 else [])]


def section(lines: Sequence[Line]) -> str:
    """The section of the document: errors here, carried, and what was found."""
    here, there, found = [], [], []
    for line in lines:
        ours = line.ours
        aside = sum(len(rows) for rows in line.peer.aside)
        theirs = "-" if ours is None or ours.found is None else str(len(ours.found.outliers))
        here.append(
            [
                line.name + (" (joint 3 told to count against the horizon)" if line.peer.horizon else ""),
                f"{line.peer.rows} ({aside} / {theirs})",
                *_heldout(line.peer.here),
                "-" if ours is None else _marked(ours.after, _least(line.peer.here)),
                f"{line.peer.seconds:.2g} / " + ("-" if ours is None else f"{ours.seconds:.2g}"),
            ]
        )
        there += [
            [line.name, o.path.stem, *_heldout(o.there), _marked(o.ours, _least(o.there))]
            for o in line.others
        ]
        if ours is not None:
            said = ours.refused if ours.found is None else "; ".join(_found(ours.found)) or "-"
            budget = "-" if ours.found is None else _budget(ours.found)
            found.append(
                [f"`{line.command}`", "-" if ours.found is None else ours.found.verdict, budget, said]
            )
    return "\n\n".join(
        [
            INTRODUCTION,
            markdown(["recording", "rows (set aside)", *STAGES, "program", "seconds"], here),
            "Carried to a run that was not learnt from, base, tool and touched points fitted there:",
            markdown(["learnt on", "judged on", *STAGES, "program"], there),
            "What the program found:",
            markdown(["command", "verdict", "where the error comes from", "found (± 95%)"], found),
        ]
    )


def _budget(d: Diagnosis) -> str:
    return " ".join(said for said in (budget_sentence(d), unexplained_sentence(d)) if said) or "-"


INTRODUCTION = """## Touches and tracker recordings

Error in mm rms of one axis on poses held out (tenfold, everything fitted anew without them), by `python -m benchmarks
real_static --write`. The ordinary calibration is plain least squares on positions (`benchmarks/_calibration`): base and
tool (or touched points); every joint zero, length and angle of every link, the shortest solution; then one stiffness a
joint, by the arm's torque sensors or its description's masses. Rows beyond 4.5 robust standard deviations of its
fullest fit are set aside before (first number; the second is what the program set aside). In bold where the best of the
ordinary ones is better than the program by more than 1%. Seconds are processor time of both, one thread. Touches at
unknown points have no scale: the longest link keeps its length."""
