"""Negative controls of joint logs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from app import catalog
from app.errors import InputError
from app.proof.controls import ATTEMPTS, TITLES, Control
from app.proof.drawing import FAMILIES, TOPOLOGIES
from app.proof.generator.effects.term import Request
from app.proof.generator.motion.cell import drive_torques
from app.proof.generator.motion.making import MadeMotion, MotionPlan, make_motion
from app.proof.generator.motion.visibility import motion_visibility
from app.proof.generator.motion.writing import write_motion
from app.proof.generator.urdf_writing import write_arm
from app.proof.matching import ALIKE, SURVIVES, TELLABLE

PLAN = MotionPlan(samples=3000)
#: Laws whose strength has one sign only.
SIGNED = ("coulomb_friction", "viscous_friction", "rotor_inertia")
REMOVABLE = (
    "torque_ripple",
    "joint_coupling",
    "contact",
    "warmup_friction",
    "payload_change",
    "stribeck_friction",
)


def draw_control(seed: int, index: int, kind: str, folder: Path) -> Control:
    """Makes one control."""
    rng = np.random.default_rng([seed, 8_000_000 + index, sorted(TITLES).index(kind)])
    maker: Callable[[np.random.Generator], tuple[MadeMotion, str, str]] = {
        "shuffled": _shuffled,
        "flipped": _flipped,
        "response": _response,
        "without": _without,
    }[kind]
    path = folder / f"{kind}_{index:03d}.csv"
    made, without, truth = maker(rng)
    write_arm(made.cell.described.changed(name=path.stem), path.with_suffix(".urdf"))
    write_motion(made, path, f"{path.stem}.urdf")
    return Control(kind, path, without, truth)


def _made(rng: np.random.Generator, plan: MotionPlan, requests: list[Request]) -> MadeMotion:
    for _ in range(ATTEMPTS):
        arm = catalog.member(TOPOLOGIES, "TOPOLOGY", str(rng.choice(FAMILIES)), what="topology").draw(rng)
        try:
            return make_motion(plan, arm, arm, requests, rng)
        except InputError:
            continue
    raise InputError("no arm carries this control")


def _shuffled(rng: np.random.Generator) -> tuple[MadeMotion, str, str]:
    made = _made(rng, PLAN, [Request("coulomb_friction")] if rng.random() < 0.5 else [])
    return replace(made, torque=made.torque[rng.permutation(made.cell.m)]), "", "shuffled"


def _flipped(rng: np.random.Generator) -> tuple[MadeMotion, str, str]:
    key = str(rng.choice(SIGNED))
    for _ in range(ATTEMPTS):
        made = _made(rng, PLAN, [Request(key)])
        term = made.terms[0]
        if _tellable(made):
            noise = made.torque - drive_torques(made.cell, made.terms)
            made = replace(made, torque=drive_torques(made.cell, [term.times(-1.0)]) + noise)
            return made, "", f"{key} {dict(term.where)} negative"
    raise InputError("no flipped control came about")


def _without(rng: np.random.Generator) -> tuple[MadeMotion, str, str]:
    for _ in range(ATTEMPTS):
        key = str(rng.choice(REMOVABLE))
        made = _made(rng, PLAN, [Request(key)])
        if _tellable(made):
            return made, key, f"{key} {dict(made.terms[0].where)}"
    raise InputError("no control without its law came about")


def _response(rng: np.random.Generator) -> tuple[MadeMotion, str, str]:
    """Clean; the temperatures are the torques' noise, which only the measured values could have told."""
    made = _made(rng, replace(PLAN, temperatures=True), [])
    error = (made.torque - drive_torques(made.cell, ())) / made.sigma
    return replace(made, temperature=30.0 + 3.0 * error), "", "clean"


def _tellable(made: MadeMotion) -> bool:
    seen = motion_visibility(made, 0, limit=ALIKE)
    return seen.survives >= SURVIVES and seen.nearest >= TELLABLE
