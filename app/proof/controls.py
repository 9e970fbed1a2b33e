"""Negative controls: recordings from which nothing may come out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from app import catalog
from app.errors import InputError
from app.proof.drawing import FAMILIES, TOPOLOGIES
from app.proof.generator.effects.term import Request
from app.proof.generator.files import read_rows, write_csv, write_static
from app.proof.generator.static.making import Made, Plan, make
from app.proof.generator.static.visibility import visibility
from app.proof.generator.urdf_writing import write_arm
from app.proof.matching import ALIKE, SURVIVES, TELLABLE

ATTEMPTS = 60
NOISE = 0.1e-3  # m


@dataclass(frozen=True)
class Control:
    """One recording to ask about.

    Args:
        kind: which control it is.
        path: the recording.
        without: the effect that is taken out of the library, if any.
        truth: what is in it, for the page.
    """

    kind: str
    path: Path
    without: str = ""
    truth: str = ""


NOTHING = ("shuffled", "response")

TITLES = {
    "shuffled": "poses and measurements shuffled against each other",
    "flipped": "the effect with the sign that physics forbids",
    "response": "a temperature column made of the measured response",
    "without": "the true law taken out of the library",
}


def draw_control(seed: int, index: int, kind: str, folder: Path) -> Control:
    """Makes one control."""
    rng = np.random.default_rng([seed, 7_000_000 + index, sorted(TITLES).index(kind)])
    maker: Callable[[np.random.Generator, Path], tuple[str, str]] = {
        "shuffled": _shuffled,
        "flipped": _flipped,
        "response": _response,
        "without": _without,
    }[kind]
    path = folder / f"{kind}_{index:03d}.csv"
    without, truth = maker(rng, path)
    return Control(kind, path, without, truth)


def _made(rng: np.random.Generator, plan: Plan, requests: list[Request]) -> Made:
    for _ in range(ATTEMPTS):
        arm = catalog.member(TOPOLOGIES, "TOPOLOGY", str(rng.choice(FAMILIES)), what="topology").draw(rng)
        try:
            return make(plan, arm, arm, requests, rng)
        except InputError:
            continue
    raise InputError("no arm carries this control")


def _written(made: Made, path: Path) -> None:
    write_arm(made.cell.described.changed(name=path.stem), path.with_suffix(".urdf"))
    write_static(made, path, f"{path.stem}.urdf")


def _plan(rng: np.random.Generator, kind: str | None = None) -> Plan:
    kind = kind or str(rng.choice(["touch", "tracker"]))
    return Plan(kind=kind, samples=80, noise=NOISE, effect_rms=0.9e-3)


def _shuffled(rng: np.random.Generator, path: Path) -> tuple[str, str]:
    made = _made(rng, _plan(rng), [Request("joint_compliance")] if rng.random() < 0.5 else [])
    order = rng.permutation(made.cell.m)
    cell = replace(made.cell, target=made.cell.target[order])
    _written(replace(made, points=made.points[order], cell=cell), path)
    return "", "shuffled"


def _flipped(rng: np.random.Generator, path: Path) -> tuple[str, str]:
    key = "joint_compliance"  # a negative gap is play that is made up for by too much, which there is
    for _ in range(ATTEMPTS):
        plan = _plan(rng, "tracker")
        made = _made(rng, plan, [Request(key)])
        (term,) = made.terms
        places = {"joint": term.where["joint"]}
        sizes = {k: -v for k, v in term.parameters.items()}
        try:
            made = make(plan, made.cell.arm, made.cell.described, [Request(key, places, sizes)], rng)
        except InputError:  # at these poses the joint does not carry the effect
            continue
        if _tellable(made):
            _written(made, path)
            return "", f"{key} {dict(term.where)} negative"
    raise InputError("no flipped control came about")


def _without(rng: np.random.Generator, path: Path) -> tuple[str, str]:
    keys = ["joint_compliance", "backlash", "gear_eccentricity", "joint_coupling", "joint_slip", "tool_slip"]
    for _ in range(ATTEMPTS):
        key = str(rng.choice(keys))
        made = _made(rng, _plan(rng, "tracker"), [Request(key)])
        if _tellable(made):
            _written(made, path)
            return key, f"{key} {dict(made.terms[0].where)}"
    raise InputError("no control without its law came about")


def _tellable(made: Made) -> bool:
    """True where no law of the library does the same, not even on an arm with all geometry off.

    Lengths and twists that add up to the law within the noise are no false names: nothing in the file denies them.
    """
    seen = visibility(made, 0, geometry=True, limit=ALIKE)  # what is open hides more, never less
    return seen.survives >= SURVIVES and seen.nearest >= TELLABLE


def _response(rng: np.random.Generator, path: Path) -> tuple[str, str]:
    """Clean; the column is the noise itself, which only the measured values could have told."""
    made = _made(rng, _plan(rng, "tracker"), [])
    _written(made, path)
    from app.proof.generator.static.cell import seen, world_with

    error = made.points[:, 0] - seen(made.cell, world_with(made.cell, ()))[:, 0]
    header, columns = read_rows(path)
    direction = error @ rng.normal(size=3) / NOISE
    columns["temperature_degC"] = [f"{20.0 + 3.0 * v:.5f}" for v in direction]
    columns["residual"] = [f"{v:.6f}" for v in direction]
    write_csv(path, header, columns)
    return "", "clean"


def named(said: Any) -> list[str]:
    """Effects that a diagnosis named."""
    return [f["effect"] for f in said.get("findings", ())]


def came_out(control: Control, said: Any) -> bool:
    """Did something come out that may not?

    Where there is nothing at all (shuffled, response) any name counts. Where there is something that the
    library does not hold (flipped, without) a name counts when the diagnosis stands by it; `partly`, with
    its left-over structure, says that it does not.
    """
    if control.kind in NOTHING:
        return bool(named(said))
    return bool(named(said)) and said.get("verdict") == "named"
