"""Draws sealed static cases: recordings into a folder, answers back to the one who seals them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from app import catalog
from app.errors import InputError, UnknownNameError
from app.proof.draft import Draft, Stratum
from app.proof.generator.files import term_json, write_static
from app.proof.generator.static.clutter import as_built, misweighed
from app.proof.generator.static.making import Made, make
from app.proof.generator.static.visibility import Visibility, visibility
from app.proof.generator.urdf_writing import write_arm
from app.proof.matching import ALIKE, SURVIVES
from app.units import mm

STRATA = "app.proof.strata.static"
TOPOLOGIES = "app.proof.generator.topologies"
#: Arms whose tool can lean every way; the four-axis ones cannot, and are left to `simulate`.
FAMILIES = ("spherical_wrist", "offset_wrist", "seven_axes")
ATTEMPTS = 40
PATIENCE = 25  # draws in search of effects that survive
#: Share of cases taken as drawn; of the others, those whose effects survive the ordinary calibration.
PLAIN = 0.25
#: Strata whose effects are hidden on purpose.
HIDDEN = ("alias",)


def strata_of(packages: Sequence[str], count: int, only: Sequence[str] = ()) -> list[str]:
    """Which stratum each of `count` cases belongs to, by their shares; every stratum at least once.

    Args:
        only: keys of the strata to take; all of them unless given.

    Raises:
        UnknownNameError: no such stratum.
    """
    strata = {k: s for package in packages for k, s in catalog.members(package, "STRATUM").items()}
    for key in only:
        if key not in strata:
            raise UnknownNameError(key, available=strata, what="stratum")
    strata = {k: s for k, s in strata.items() if not only or k in only}
    total = sum(s.share for s in strata.values())
    each = {key: max(1, round(count * stratum.share / total)) for key, stratum in strata.items()}
    while sum(each.values()) < count:
        each[max(strata, key=lambda key: strata[key].share)] += 1
    while sum(each.values()) > count:
        each[max(each, key=lambda key: each[key])] -= 1
    return [key for key, cases in each.items() for _ in range(cases)]


def draw_static(seed: int, index: int, stratum_key: str, folder: Path) -> dict[str, Any]:
    """Makes case `index` of a run; the recording and description go to `folder`, the answer is returned."""
    stratum: Stratum = catalog.member(STRATA, "STRATUM", stratum_key, what="stratum")
    rng = np.random.default_rng([seed, index])
    made, seen, draft, topology = _make(stratum, rng)
    name = f"case_{index:04d}"
    write_arm(made.cell.described.changed(name=name), folder / f"{name}.urdf")
    write_static(made, folder / f"{name}.csv", f"{name}.urdf")
    return answer_of(made, seen, draft, {"id": name, "stratum": stratum_key, "topology": topology})


def _make(stratum: Stratum, rng: np.random.Generator) -> tuple[Made, list[Visibility], Draft, str]:
    """A case that can be made; most of them with effects that survive the ordinary calibration."""
    plain = bool(rng.random() < PLAIN)
    best: tuple[Made, Draft, str] | None = None
    for attempt in range(ATTEMPTS):
        topology = str(rng.choice(FAMILIES))
        described = catalog.member(TOPOLOGIES, "TOPOLOGY", topology, what="topology").draw(rng)
        draft = stratum.draft(rng)
        arm = as_built(described, draft.clutter, rng) if draft.clutter else described
        arm = misweighed(arm, draft.wrong_masses, rng) if draft.wrong_masses else arm
        try:
            made = make(draft.plan, arm, described, draft.requests, rng)
        except InputError:  # this arm cannot carry this effect, or cannot touch so many times
            continue
        geometry = draft.clutter > 0
        each = range(len(made.terms))
        seen = [visibility(made, i, geometry=geometry, limit=None) for i in each]
        best = made, draft, topology
        if plain or stratum.key in HIDDEN or all(v.survives >= SURVIVES for v in seen) or attempt > PATIENCE:
            break
    if best is None:
        raise InputError(f"stratum {stratum.key} drew no case that can be made")
    made, draft, topology = best
    geometry = draft.clutter > 0
    seen = [visibility(made, i, geometry=geometry, limit=ALIKE) for i in range(len(made.terms))]
    return made, seen, draft, topology


def answer_of(made: Made, seen: Sequence[Visibility], draft: Draft, names: dict[str, Any]) -> dict[str, Any]:
    """Everything the scorer needs to know, JSON types only."""
    truths = [
        {
            **term_json(term),
            "raw_rms_mm": mm(raw),
            "survives": visible.survives,
            "nearest": visible.nearest,
            "lookalikes": list(visible.lookalikes),
        }
        for term, raw, visible in zip(made.terms, made.raw_rms, seen, strict=True)
    ]
    plan = asdict(made.plan)
    return {
        **names,
        "kind": made.plan.kind,
        "truth": truths,
        "noise_mm": mm(made.plan.noise),
        "clutter_mm": mm(draft.clutter),
        "wrong_masses": draft.wrong_masses,
        "outlier_rows": [int(i) + 1 for i in made.outliers],
        "plan": {k: list(v) if isinstance(v, tuple) else v for k, v in plan.items()},
    }
