"""The proof from seed to scorecard: draw, seal, ask, open, score."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from app import __version__, catalog
from app.errors import InputError
from app.proof.asking import ask, ask_whole, everywhere
from app.proof.controls import came_out, named
from app.proof.drawing import strata_of
from app.proof.families import FAMILIES
from app.proof.intervals import Rate
from app.proof.scoring import Score, heldout_summary, score
from app.proof.verdicts import Judged, judge

Say = Callable[[str], None]
MOST = 100_000


@dataclass(frozen=True)
class Proof:
    """A finished run.

    Args:
        seal: SHA-256 of the answers' file, printed before anything was asked.
        controls: kind -> how often something was named, and what.
    """

    family: str
    seed: int
    command: str
    seal: str
    score: Score
    judged: Sequence[Judged]
    controls: dict[str, tuple[Rate, list[str]]]
    seconds: float
    versions: dict[str, str]


def prove(
    family_key: str,
    cases: int,
    seed: int,
    out: Path,
    *,
    tell: Say,
    say: Say,
    processes: int | None = None,
    only: Sequence[str] = (),
    with_controls: bool = True,
) -> Proof:
    """Runs the proof; `tell` gets what belongs on stdout, `say` the progress.

    Args:
        only: strata to draw from; all of them unless given.

    Raises:
        InputError: no such family, or a number of cases that cannot be.
    """
    family = FAMILIES.get(family_key)
    if family is None:
        raise InputError(f"nothing to prove about {family_key!r}", expected=" or ".join(FAMILIES))
    if not 1 <= cases <= MOST:
        raise InputError(f"{cases} cases", expected=f"1 to {MOST}")
    folder = out / "recordings"
    folder.mkdir(parents=True, exist_ok=True)
    strata = strata_of((family.strata, *family.whole), cases, only)
    jobs = [(family_key, seed, index, stratum, folder) for index, stratum in enumerate(strata)]
    answers = everywhere(drawn, jobs, lambda share: say(f"drawing {share:4.0%}"), processes)
    sealed = out / "answers.json"
    sealed.write_text(json.dumps(answers, indent=1) + "\n", encoding="utf-8")
    seal = _seal(sealed)
    tell(f"seed {seed}, {cases} cases; SHA-256 of the answers before anything is asked: {seal}")
    files = [(folder / f"{a['id']}.csv", *_others(a, folder)) for a in answers]
    del answers
    said = everywhere(asked, files, lambda share: say(f"asking  {share:4.0%}"), processes)
    (out / "said.json").write_text(json.dumps(said, indent=1) + "\n", encoding="utf-8")
    if _seal(sealed) != seal:
        raise InputError("the answers were changed while the questions were asked", file=sealed)
    opened = json.loads(sealed.read_text(encoding="utf-8"))
    strange = family.strange()
    judged = [judge(a, s, strange) for a, s in zip(opened, said, strict=True)]
    each = max(1, cases // 20)
    found = _controls(family, seed, each, folder, say, processes) if with_controls else {}
    return Proof(
        family=family_key,
        seed=seed,
        command=" ".join(
            [
                f"teachframe prove {family_key} --cases {cases} --seed {seed}",
                *(["--strata", *only] if only else []),
            ]
        ),
        seal=seal,
        score=score(judged, family_key),
        judged=judged,
        controls=found,
        seconds=sum(s["processor_seconds"] for s in said),
        versions={
            "teachframe": __version__,
            "python": platform.python_version(),
            "numpy": version("numpy"),
            "pin": version("pin"),
            "machine": platform.machine(),
        },
    )


def drawn(family_key: str, seed: int, index: int, stratum: str, folder: Path) -> dict[str, Any]:
    """One case, by the one who draws its stratum."""
    family = FAMILIES[family_key]
    whole = any(stratum in catalog.members(package, "STRATUM") for package in family.whole)
    draw = family.draw_whole if whole else family.draw
    return draw(seed, index, stratum, folder)


def _others(answer: dict[str, Any], folder: Path) -> list[Path]:
    """The further recordings of a case: the second run of the same arm, and a reference where there is one."""
    whole = answer.get("whole") or {}
    return [folder / whole[key] for key in ("second", "reference") if whole.get(key)]


def asked(path: Path, *others: Path) -> dict[str, Any]:
    """What is said of one case."""
    return ask_whole(path, *others) if others else ask(path)


def _controls(family, seed, each, folder, say, processes):
    jobs = [(seed, index, kind, folder) for kind in family.controls for index in range(each)]
    drawn = everywhere(family.draw_control, jobs, lambda share: say(f"controls {share:4.0%}"), processes)
    asked = [(c.path, c.without) for c in drawn]
    said = everywhere(ask, asked, lambda share: say(f"controls {share:4.0%}"), processes)
    found = {}
    for kind in family.controls:
        pairs = [(c, s) for c, s in zip(drawn, said, strict=True) if c.kind == kind]
        wrong = [
            f"{c.path.stem} ({c.truth}): {', '.join(named(s))} ({s.get('verdict')})"
            for c, s in pairs
            if named(s)
        ]
        found[kind] = (Rate(sum(came_out(c, s) for c, s in pairs), len(pairs)), wrong)
    return found


def _seal(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def as_json(proof: Proof) -> dict[str, Any]:
    """The scorecard as data."""
    return {
        "format": "teachframe.proof/1",
        "family": proof.family,
        "seed": proof.seed,
        "command": proof.command,
        "answers_sha256": proof.seal,
        "versions": proof.versions,
        "lines": [
            {**asdict(line), "value": line.rate.value, "interval": line.rate.interval, "met": line.met}
            for line in proof.score.lines
        ],
        "confusion": proof.score.confusion,
        "heldout": heldout_summary([v for _, v in proof.score.heldout]),
        "transfer": proof.score.transfer,
        "coverage": {k: _rate(v) for k, v in proof.score.coverage.items()},
        "effects": {
            name: {"place": _rate(p), "name": _rate(n), "set": _rate(s)}
            for name, p, n, s in proof.score.effects
        },
        "controls": {k: {**_rate(r), "named": w} for k, (r, w) in proof.controls.items()},
        "failures": [failure(case) for case in proof.judged if failed(case)],
        "seconds_of_diagnosis": proof.seconds,
    }


def _rate(rate: Rate) -> dict[str, Any]:
    return {**asdict(rate), "value": rate.value, "interval": rate.interval}


def failed(case: Judged) -> bool:
    """Something was said that is not so, or not said that could be."""
    if case.verdict == "error":
        return True
    if case.whole is not None:
        return bool(case.whole.misses)
    return bool(case.false) or not all(case.name)


def failure(case: Judged) -> dict[str, Any]:
    """One failure, as plain as it can be put."""
    truth = [
        f"{t['effect']} {_where(t['where'])}{_explains(t)} (survives {t['survives']:.1f} sigma, "
        f"nearest other {t['nearest']:.1f})"
        for t in case.answer["truth"]
    ]
    said = [
        f"{f['effect']} {_where(f['where'])}"
        + (" [true]" if f not in (case.whole.untrue if case.whole else case.false) else "")
        + (f" or {len(f['alternatives'])} others" if f.get("alternatives") else "")
        for f in case.findings
    ]
    return {
        "case": case.answer["id"],
        "stratum": case.answer["stratum"],
        "recording": f"{case.answer['kind']}, {case.answer['topology']}",
        "true": "; ".join(truth) or "nothing",
        "verdict": case.verdict,
        "said": case.said.get("error") or "; ".join(said) or "nothing",
        "leftover": (case.said.get("leftover") or {}).get("where") or {},
        "in_set": list(case.listed),
        "misses": list(case.whole.misses) if case.whole is not None else [],
    }


def _explains(truth: dict[str, Any]) -> str:
    """How much of the error a dominant effect explains."""
    return f", {truth['share']:.0%}" if "share" in truth else ""


def _where(where: dict[str, Any]) -> str:
    return " ".join(f"{key}={value}" for key, value in where.items())
