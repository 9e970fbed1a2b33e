"""What every unknown and every law does to the torques of a log, on a thinned set of samples."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np

from app import catalog
from app.errors import InputError
from app.proof.generator.arm import Arm
from app.proof.generator.dynamics import GRAVITY, moving_torques
from app.proof.generator.effects.term import Term
from app.proof.generator.motion.cell import LAWS, Motion, drive_torques, effect_on_torques
from app.proof.generator.motion.making import MadeMotion

#: Samples that visibility is computed on; lengths are scaled to the whole log.
SAMPLES = 250
#: How far a description's inertial numbers are believed: share of mass, of a link's size, of its inertia.
PRIOR = (0.03, 0.03, 0.10)
DRIVERS = {"joint_coupling": ("speed", "acceleration")}
ORDERS = (3.0, 5.0, 8.0, 12.0, 18.0)


@dataclass(frozen=True, eq=False)
class Thin:
    """A log thinned out, every torque divided by its noise and by nothing else.

    Args:
        cell: with fewer samples.
        sigma: (n,) [Nm].
        weight: what a length has to be multiplied by to hold for the whole log.
    """

    cell: Motion
    sigma: np.ndarray
    weight: float

    def reading(self, terms: Sequence[Term]) -> np.ndarray:
        """(m n,) torques over noise."""
        return (drive_torques(self.cell, terms) / self.sigma).ravel()

    def effect(self, terms: Sequence[Term], term: Term) -> np.ndarray:
        """(m n,) what one term does beside the others, over noise."""
        return (effect_on_torques(self.cell, terms, term) / self.sigma).ravel()


def thinned(made: MadeMotion) -> Thin:
    """About `SAMPLES` samples, drawn evenly over the log but not in step with it."""
    m = made.cell.m
    count = min(m, SAMPLES)
    index = np.sort(np.random.default_rng(0).choice(m, count, replace=False))
    return Thin(replace(made.cell, t=made.cell.t[index]), made.sigma, float(np.sqrt(m / count)))


def inertial_columns(thin: Thin) -> np.ndarray:
    """(m n, 10 n) torque per one-sigma error of every link's mass, centre and inertia."""
    cell, arm = thin.cell, thin.cell.arm
    columns = []
    for k in range(arm.n):
        mass = max(float(arm.masses[k]), 0.01 * float(arm.masses.max()))
        trace = max(float(np.trace(arm.inertias[k])), 2.0 * mass * 0.02**2)
        size = max(np.sqrt(trace / (2.0 * mass)), 0.05)
        for change in _inertial_changes(arm, k, mass, size, trace):
            moved = moving_torques(change, *cell.state) - cell.rigid
            columns.append((moved / thin.sigma).ravel())
    return np.stack(columns, axis=1)


def _inertial_changes(arm: Arm, k: int, mass: float, size: float, trace: float) -> Iterator[Arm]:
    masses = arm.masses.copy()
    masses[k] += PRIOR[0] * mass
    heavier = arm.inertias.copy()
    heavier[k] *= 1.0 + PRIOR[0]
    yield arm.changed(masses=masses, inertias=heavier)
    for axis in range(3):
        coms = arm.coms.copy()
        coms[k, axis] += PRIOR[1] * size
        yield arm.changed(coms=coms)
    for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)):
        inertias = arm.inertias.copy()
        inertias[k, i, j] += PRIOR[2] * trace / 3.0
        inertias[k, j, i] = inertias[k, i, j]
        yield arm.changed(inertias=inertias)


def term_columns(thin: Thin, terms: Sequence[Term], term: Term) -> np.ndarray:
    """(m n, k) a term's strengths, one column each, on top of `terms`; shapes (a speed, an order) held."""
    names = [name for name in term.parameters if name not in SHAPES]
    base = thin.reading(terms)
    if term.effect in ALL_SHAPE:
        return (thin.reading([*terms, term]) - base)[:, None]
    columns = [(thin.reading([*terms, _only(term, name)]) - base) / STEP for name in names]
    return np.stack(columns, axis=1) if columns else np.zeros((base.size, 0))


SHAPES = ("stribeck_speed", "order", "time_constant")
ALL_SHAPE = ("elastic_joint",)  # no strength of its own: the whole of it is one column
STEP = 1e-3  # Nm, kg, s …: small against every curve, large against rounding


def _only(term: Term, name: str) -> Term:
    """The term with one strength at STEP and the others at nothing."""
    values = {k: v if k in SHAPES else 0.0 for k, v in term.parameters.items()}
    if term.effect == "gravity_direction":
        values = {key: float(g) for key, g in zip(("gx", "gy", "gz"), GRAVITY, strict=True)}
        values[name] += STEP
    elif term.effect in ("payload", "payload_change"):
        # first moments matter, and a mass must be there to have one
        values = {"mass": STEP, "com_x": 0.0, "com_y": 0.0, "com_z": 0.0}
        if name != "mass":
            values[name] = 1.0
    else:
        values[name] = STEP
    return replace(term, parameters=values)


def places(thin: Thin) -> Iterator[Term]:
    """Every law of the library at every place it could have in this log; shapes on a grid, windows left out."""
    cell, rng = thin.cell, np.random.default_rng(0)
    n = cell.arm.n
    for key, law in catalog.members(LAWS, "EFFECT").items():
        if "from_s" in law.places:
            continue
        options: dict[str, Sequence[Any]] = {}
        if "joint" in law.places:
            options["joint"] = range(1, n + 1)
        if "source_joint" in law.places:
            options["source_joint"] = range(1, n + 1)
        if "link" in law.places:  # none: where it sits if nothing is asked for
            options["link"] = [*([None] if key == "payload" else []), *range(1, n + 1)]
        if key in DRIVERS:
            options["driver"] = DRIVERS[key]
        for chosen in product(*options.values()):
            asked = {k: v for k, v in zip(options, chosen, strict=True) if v is not None}
            if asked.get("source_joint", 0) == asked.get("joint", -1):
                continue
            try:
                yield from _shapes(law.draw(rng, cell, asked), cell)
            except InputError:
                continue


def _shapes(term: Term, cell: Motion) -> Iterator[Term]:
    """The term with each shape its nonlinear parameter may take."""
    values = dict(term.parameters)
    if "stribeck_speed" in values:
        usual = float(np.quantile(np.abs(cell.qd[:, term.where["joint"] - 1]), 0.9))
        grid = [("stribeck_speed", share * usual) for share in (0.1, 0.2, 0.4)]
    elif "time_constant" in values:
        grid = [("time_constant", share * float(np.ptp(cell.t))) for share in (0.15, 0.4, 1.0)]
    elif "order" in values:
        grid = [("order", order) for order in ORDERS]
    else:
        grid = []
    if not grid:
        yield term
    for name, value in grid:
        yield replace(term, parameters={**values, name: float(value)})
