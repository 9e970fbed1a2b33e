"""Draws sealed joint logs: recordings into a folder, answers back to the one who seals them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from app import catalog
from app.errors import InputError
from app.proof.draft import Draft, Stratum
from app.proof.drawing import ATTEMPTS, FAMILIES, HIDDEN, PLAIN, TOPOLOGIES
from app.proof.generator.files import term_json
from app.proof.generator.motion.making import MadeMotion, make_motion
from app.proof.generator.motion.visibility import motion_visibility
from app.proof.generator.motion.writing import write_motion
from app.proof.generator.static.clutter import misweighed
from app.proof.generator.static.visibility import Visibility
from app.proof.generator.urdf_writing import write_arm
from app.proof.matching import ALIKE, SURVIVES

STRATA = "app.proof.strata.motion"
PATIENCE = 6  # draws in search of an effect that survives


def draw_motion(seed: int, index: int, stratum_key: str, folder: Path) -> dict[str, Any]:
    """Makes case `index` of a run; the recording and description go to `folder`, the answer is returned."""
    stratum: Stratum = catalog.member(STRATA, "STRATUM", stratum_key, what="stratum")
    rng = np.random.default_rng([seed, index, 1])
    made, seen, draft, topology = _make(stratum, rng)
    name = f"case_{index:04d}"
    write_arm(made.cell.described.changed(name=name), folder / f"{name}.urdf")
    write_motion(made, folder / f"{name}.csv", f"{name}.urdf")
    return _answer(made, seen, draft, {"id": name, "stratum": stratum_key, "topology": topology})


def _make(stratum: Stratum, rng: np.random.Generator) -> tuple[MadeMotion, list[Visibility], Draft, str]:
    plain = bool(rng.random() < PLAIN) or stratum.key in HIDDEN
    best: tuple[MadeMotion, Draft, str] | None = None
    tries = 0
    for _ in range(ATTEMPTS):
        topology = str(rng.choice(FAMILIES))
        described = catalog.member(TOPOLOGIES, "TOPOLOGY", topology, what="topology").draw(rng)
        draft = stratum.draft(rng)
        arm = misweighed(described, draft.wrong_masses, rng) if draft.wrong_masses else described
        try:
            made = make_motion(draft.plan, arm, described, draft.requests, rng)
        except InputError:  # this arm or log cannot carry this effect
            continue
        seen = [motion_visibility(made, i, limit=None) for i in range(len(made.terms))]
        best = made, draft, topology
        tries += 1
        if plain or all(v.survives >= SURVIVES for v in seen) or tries >= PATIENCE:
            break
    if best is None:
        raise InputError(f"stratum {stratum.key} drew no case that can be made")
    made, draft, topology = best
    limit = None if stratum.key in HIDDEN else ALIKE
    seen = [motion_visibility(made, i, limit=limit) for i in range(len(made.terms))]
    return made, seen, draft, topology


def _answer(
    made: MadeMotion, seen: Sequence[Visibility], draft: Draft, names: dict[str, Any]
) -> dict[str, Any]:
    """Everything the scorer needs to know, JSON types only."""
    truths = [
        {
            **term_json(term),
            "raw_rms_Nm": [float(v) for v in raw],
            "survives": visible.survives,
            "nearest": visible.nearest,
            "lookalikes": list(visible.lookalikes),
        }
        for term, raw, visible in zip(made.terms, made.raw_rms, seen, strict=True)
    ]
    return {
        **names,
        "kind": "motion",
        "truth": truths,
        "noise_Nm": [float(s) for s in made.sigma],
        "friction": made.plan.friction,
        "wrong_masses": draft.wrong_masses,
        "plan": asdict(made.plan),
    }
