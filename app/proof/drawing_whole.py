"""Draws sealed cases of arms that are off everywhere: two recordings into a folder, the answer back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from app import catalog
from app.errors import InputError
from app.proof.drawing import ATTEMPTS, FAMILIES, TOPOLOGIES
from app.proof.generator.files import term_json, write_static
from app.proof.generator.static.cell import OUTSIDE
from app.proof.generator.static.making import Made
from app.proof.generator.static.members import FAMILY_OF
from app.proof.generator.static.whole import WholeMade, make_whole
from app.proof.generator.urdf_writing import write_arm
from app.proof.matching import ALIKE
from app.units import mm

STRATA = "app.proof.strata.whole_static"


def draw_whole_static(seed: int, index: int, stratum_key: str, folder: Path) -> dict[str, Any]:
    """Makes case `index` of a run: CASE.csv, CASE_second.csv and the description; the answer is returned."""
    stratum = catalog.member(STRATA, "STRATUM", stratum_key, what="stratum")
    rng = np.random.default_rng([seed, index, 2])
    outside = frozenset(catalog.members(OUTSIDE, "EFFECT"))
    for _ in range(ATTEMPTS):
        topology = str(rng.choice(FAMILIES))
        described = catalog.member(TOPOLOGIES, "TOPOLOGY", topology, what="topology").draw(rng)
        whole = stratum.draft(rng)
        try:
            made = make_whole(whole, described, rng, outside=outside, limit=ALIKE)
        except InputError:  # this arm cannot carry this effect, or cannot touch so many times
            continue
        name = f"case_{index:04d}"
        write_arm(described.changed(name=name), folder / f"{name}.urdf")
        order = rng.permutation(made.first.cell.m) if whole.plan.shuffled else None
        write_static(
            made.first, folder / f"{name}.csv", f"{name}.urdf", None if order is None else order.tolist()
        )
        write_static(made.second, folder / f"{name}_second.csv", f"{name}.urdf")
        names = {"id": name, "stratum": stratum_key, "topology": topology}
        return _answer(made, order, names, whole.masses, outside)
    raise InputError(f"stratum {stratum_key} drew no case that can be made")


def _answer(
    made: WholeMade,
    order: np.ndarray | None,
    names: dict[str, Any],
    masses: float,
    outside: frozenset[str],
) -> dict[str, Any]:
    """Everything the scorer needs to know, JSON types only."""
    first, plan = made.first, asdict(made.first.plan)
    terms = [{**term_json(m.term), "norm": n} for m, n in zip(made.members, made.norms, strict=True)]
    components = 1 if first.plan.wire else 3 * first.points.shape[1]
    truth = [
        {
            **terms[-1],
            "norm": made.norm,
            "survives": made.norm / (first.cell.m * components) ** 0.5,
            "nearest": made.nearest,
            "lookalikes": list(made.lookalikes),
            "share": made.dominant_share,
            "value_sd": made.value_sd,
        }
    ]
    return {
        **names,
        "kind": first.plan.kind,
        "truth": truth if made.dominant else [],
        "noise_mm": mm(first.plan.noise),
        "clutter_mm": 0.0,
        "outlier_rows": _rows(first, order),
        "plan": {k: list(v) if isinstance(v, tuple) else v for k, v in plan.items()},
        "whole": {
            "members": terms,
            "families": {k: {"share": share, "sigma": sigma} for k, (share, sigma) in made.shares.items()},
            "shared_out": shared_out(made.lookalikes, terms[-1]["effect"], FAMILY_OF),
            "settled": not made.dominant or terms[-1]["effect"] in (*FAMILY_OF, *outside),
            "masses": masses,
            "lean": first.plan.lean,
            "second": f"{names['id']}_second.csv",
            "unit": "mm",
            "oracle": None if made.oracle is None else mm(made.oracle),
            "informed": None if made.informed is None else mm(made.informed),
            "floor": mm(made.second.plan.noise),
        },
    }


def shared_out(
    lookalikes: Sequence[Mapping[str, Any]], effect: str, family_of: Mapping[str, str]
) -> list[str]:
    """Families between which a dominant effect cannot be told to belong: nobody can know their shares."""
    inside = {family_of.get(name, "") for name in (effect, *(a["effect"] for a in lookalikes))}
    return sorted(inside) if len(inside) > 1 else []


def _rows(made: Made, order: np.ndarray | None) -> list[int]:
    """Rows of the file (from 1) that went wrong."""
    wrong = made.outliers if order is None else np.flatnonzero(np.isin(order, made.outliers))
    return [int(i) + 1 for i in wrong]
