"""All cases together: rates with intervals beside what they should be."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from app.proof.intervals import Rate
from app.proof.lines import Line
from app.proof.scoring_whole import transfer_summary, whole_lines
from app.proof.verdicts import Judged


@dataclass(frozen=True)
class Score:
    """The whole: lines, confusion, held-out ratios, per-effect table."""

    lines: Sequence[Line]
    confusion: Mapping[str, Mapping[str, int]]
    heldout: Sequence[tuple[str, float]]
    effects: Sequence[tuple[str, Rate, Rate, Rate]]
    strata: Sequence[tuple[str, Rate]]
    coverage: Mapping[str, Rate]
    transfer: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)


AIMS: dict[str, dict[str, float]] = {
    "static": {"clean": 0.01, "place": 0.99, "name": 0.99, "set": 0.98, "pair": 0.98, "outside": 0.05},
    "motion": {"clean": 0.01, "place": 0.98, "name": 0.98, "set": 0.98, "pair": 0.98, "outside": 0.05},
}
CLUTTER = {"static": "one effect, all geometry off", "motion": "one effect, friction in every joint"}
COVERED = (0.92, 0.98)
#: Clean recordings that are called anything else.
NOT_CLEAN = 0.05
#: Held-out error over the noise floor, median of the cases answered rightly.
HELDOUT = 1.05


def score(cases: Sequence[Judged], family: str) -> Score:
    """Rates of one family of recordings ("static" or "motion")."""
    aim = AIMS[family]
    everything, cases = cases, [c for c in cases if c.whole is None]
    ordinary = _in(cases, "single")
    cluttered = _in(cases, "clutter")
    everyone = [c for c in cases if c.seen and len(c.answer["truth"]) == 1]
    pairs = [c for c in _in(cases, "pair") if len(c.seen) == 2]
    outside = _in(cases, "outside")
    silent = [c for c in cases if c.empty and c.answer["stratum"] != "outside"]
    lines = [
        Line(
            "clean",
            "clean, falsely named",
            _rate(_in(cases, "clean"), lambda c: bool(c.false)),
            aim["clean"],
            True,
        ),
        Line(
            "clean_all", "nothing wrong, any stratum, falsely named", _rate(silent, lambda c: bool(c.false))
        ),
        Line(
            "clean_alarm",
            "clean, not called clean (unexplained included)",
            _rate(_in(cases, "clean"), lambda c: c.verdict != "clean"),
            NOT_CLEAN,
            True,
        ),
        *_located("single", "one effect", ordinary, aim),
        *_located("clutter", CLUTTER[family], cluttered, aim),
        *_located("one", "one effect, every stratum", everyone, aim),
        Line("set", "truth in the reported set", _all(everyone + pairs, lambda c: c.listed), aim["set"]),
        Line("pair", "pairs, both named", _rate(pairs, lambda c: all(c.name)), aim["pair"]),
        Line("pair_right", "pairs, both named and nothing else", _rate(pairs, lambda c: c.right)),
        Line(
            "outside",
            "unknown effect, falsely named",
            _rate(outside, lambda c: c.verdict == "named" and bool(c.false)),
            aim["outside"],
            True,
        ),
        Line(
            "outside_partly",
            "unknown effect, any name at all (partly included)",
            _rate(outside, lambda c: bool(c.false)),
        ),
        Line(
            "outside_tellable",
            "… of those that differ enough from every law of the library",
            _rate([c for c in outside if c.tellable], lambda c: c.verdict == "named" and bool(c.false)),
            aim["outside"],
            True,
        ),
        Line(
            "alias",
            "hidden in base, tool or targets, falsely named",
            _rate(_in(cases, "alias"), lambda c: bool(c.false)),
            aim["clean"],
            True,
        ),
        Line("faint", "too faint to be told, falsely named", _rate(_faint(cases), lambda c: bool(c.false))),
        Line(
            "cover", "stated 95% intervals that hold", _coverage(cases), COVERED[0], also_at_most=COVERED[1]
        ),
        Line("error", "refused or failed", _rate(everything, lambda c: c.verdict == "error"), 0.0, True),
    ]
    return Score(
        lines=[*(line for line in lines if line.rate.cases), *whole_lines(everything)],
        confusion=_confusion(cases),
        heldout=[
            (c.answer["stratum"], c.heldout) for c in cases if c.heldout is not None and (c.right or c.empty)
        ],
        effects=_per_effect(cases),
        strata=[
            (s, _rate(_in(cases, s), lambda c: c.right)) for s in sorted({c.answer["stratum"] for c in cases})
        ],
        coverage=_coverage_by_effect(cases),
        transfer={k: t for k in ("transfer", "over_best") if (t := transfer_summary(everything, k))},
    )


def _located(key: str, title: str, cases: Sequence[Judged], aim: Mapping[str, float]) -> list[Line]:
    cases = [c for c in cases if c.seen]
    return [
        Line(f"{key}_place", f"{title}: place right", _all(cases, lambda c: c.place), aim["place"]),
        Line(f"{key}_name", f"{title}: name right", _all(cases, lambda c: c.name), aim["name"]),
        Line(f"{key}_right", f"{title}: name right and nothing else named", _rate(cases, lambda c: c.right)),
    ]


def _in(cases: Iterable[Judged], stratum: str) -> list[Judged]:
    return [c for c in cases if c.answer["stratum"] == stratum]


def _faint(cases: Iterable[Judged]) -> list[Judged]:
    return [
        c
        for c in cases
        if c.answer["truth"] and not c.seen and not c.empty and c.answer["stratum"] != "alias"
    ]


def _rate(cases: Sequence[Judged], hit: Callable[[Judged], bool]) -> Rate:
    return Rate(sum(bool(hit(c)) for c in cases), len(cases))


def _all(cases: Sequence[Judged], flags: Callable[[Judged], Sequence[bool]]) -> Rate:
    values = [flag for c in cases for flag in flags(c)]
    return Rate(sum(values), len(values))


def _coverage(cases: Sequence[Judged]) -> Rate:
    """Wrong masses bias a compliance by as much as they are wrong: not counted, as no interval can know it."""
    inside = [ok for c in cases if not c.answer.get("wrong_masses") for _, _, ok in c.covered]
    return Rate(sum(inside), len(inside))


def _coverage_by_effect(cases: Sequence[Judged]) -> dict[str, Rate]:
    found: dict[str, list[bool]] = {}
    for case in cases:
        if not case.answer.get("wrong_masses"):
            for effect, _, inside in case.covered:
                found.setdefault(effect, []).append(inside)
    return {effect: Rate(sum(v), len(v)) for effect, v in sorted(found.items())}


def _confusion(cases: Sequence[Judged]) -> dict[str, dict[str, int]]:
    """True effect -> what was said first (of cases with at most one effect that survives)."""
    table: dict[str, Counter] = {}
    for case in cases:
        truths = case.answer["truth"]
        if len(truths) > 1:
            continue
        if not truths:
            row = "(nothing)"
        elif case.empty:
            row = f"({truths[0]['effect']})"
        elif not case.seen:
            row = "(too faint)"
        else:
            row = truths[0]["effect"]
        matching = [f for f in case.findings if f not in case.false]
        first = (matching or list(case.findings))[:1]
        said = first[0]["effect"] if first else f"({case.verdict})"
        if first and case.seen and not matching and said == row:
            said = f"{said}, elsewhere"
        table.setdefault(row, Counter())[said] += 1
    return {row: dict(columns) for row, columns in sorted(table.items())}


def _per_effect(cases: Sequence[Judged]) -> list[tuple[str, Rate, Rate, Rate]]:
    names = sorted({t["effect"] for c in cases for t in c.seen})
    out = []
    for name in names:
        rows = [
            (p, n, s)
            for c in cases
            for t, p, n, s in zip(c.seen, c.place, c.name, c.listed, strict=True)
            if t["effect"] == name
        ]
        out.append((name, *(Rate(sum(r[k] for r in rows), len(rows)) for k in range(3))))
    return out


def heldout_summary(ratios: Sequence[float]) -> dict[str, Any]:
    """Median and middle half of held-out error over the noise floor, and whether the median meets its aim."""
    if not ratios:
        return {}
    low, middle, high = (float(v) for v in np.quantile(ratios, [0.25, 0.5, 0.75]))
    return {
        "cases": len(ratios),
        "lower_quartile": low,
        "median": middle,
        "upper_quartile": high,
        "aim": HELDOUT,
        "met": middle <= HELDOUT,
    }
