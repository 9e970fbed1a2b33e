"""Draws sealed logs of arms whose links and joints are none as described."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from app import catalog
from app.errors import InputError
from app.proof.drawing import ATTEMPTS, FAMILIES, TOPOLOGIES
from app.proof.drawing_whole import shared_out
from app.proof.generator.files import term_json
from app.proof.generator.motion.cell import OUTSIDE
from app.proof.generator.motion.members import FAMILY_OF
from app.proof.generator.motion.whole import WholeLogMade, make_whole_log
from app.proof.generator.motion.writing import write_motion
from app.proof.generator.urdf_writing import write_arm
from app.proof.matching import ALIKE

STRATA = "app.proof.strata.whole_motion"
#: Nobody says how a link's excess is to be stated.
NO_VALUE = ("link_inertia",)


def draw_whole_motion(seed: int, index: int, stratum_key: str, folder: Path) -> dict[str, Any]:
    """Makes case `index` of a run: CASE.csv, CASE_second.csv and, for some, CASE_reference.csv."""
    stratum = catalog.member(STRATA, "STRATUM", stratum_key, what="stratum")
    rng = np.random.default_rng([seed, index, 3])
    outside = frozenset(catalog.members(OUTSIDE, "EFFECT"))
    for _ in range(ATTEMPTS):
        topology = str(rng.choice(FAMILIES))
        described = catalog.member(TOPOLOGIES, "TOPOLOGY", topology, what="topology").draw(rng)
        whole = stratum.draft(rng)
        try:
            made = make_whole_log(whole, described, rng, outside=outside, limit=ALIKE)
        except InputError:  # this arm or log cannot carry this effect
            continue
        name = f"case_{index:04d}"
        write_arm(described.changed(name=name), folder / f"{name}.urdf")
        logs = {"": made.first, "_second": made.second, "_reference": made.reference}
        for mark, log in logs.items():
            if log is not None:
                write_motion(log, folder / f"{name}{mark}.csv", f"{name}.urdf")
        return _answer(made, outside, {"id": name, "stratum": stratum_key, "topology": topology})
    raise InputError(f"stratum {stratum_key} drew no case that can be made")


def _answer(made: WholeLogMade, outside: frozenset[str], names: dict[str, Any]) -> dict[str, Any]:
    """Everything the scorer needs to know, JSON types only."""
    first, referenced = made.first, made.reference is not None
    terms = [{**term_json(m.term), "norm": n} for m, n in zip(made.members, made.norms, strict=True)]
    truth = [
        {
            **terms[-1],
            "norm": made.norm,
            "survives": made.norm / (first.cell.m * first.cell.arm.n) ** 0.5,
            "nearest": made.nearest,
            "lookalikes": list(made.lookalikes),
            "share": made.dominant_share,
            "value_sd": None if terms[-1]["effect"] in NO_VALUE else made.value_sd,
        }
    ]
    return {
        **names,
        "kind": "motion",
        "truth": truth if made.dominant else [],
        "noise_Nm": [float(s) for s in first.sigma],
        "friction": 0.0,
        "wrong_masses": made.masses,
        "plan": asdict(first.plan),
        "whole": {
            "members": terms,
            "families": {}
            if referenced
            else {k: {"share": share, "sigma": 0.0} for k, share in made.shares.items()},
            "shared_out": shared_out(made.lookalikes, terms[-1]["effect"], FAMILY_OF),
            "settled": not referenced
            and (not made.dominant or terms[-1]["effect"] in (*FAMILY_OF, *outside)),
            "masses": made.masses,
            "second": f"{names['id']}_second.csv",
            "reference": f"{names['id']}_reference.csv" if referenced else None,
            "unit": "Nm",
            "oracle": None if referenced else made.oracle,
            "informed": None,
            "floor": made.floor,
        },
    }
