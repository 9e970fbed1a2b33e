"""What every unknown and every law does to the readings: columns by differences of the exact forward model."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from app import catalog
from app.errors import InputError
from app.proof.generator.arm import link_axes
from app.proof.generator.effects.term import Term
from app.proof.generator.rotations import turn_vector
from app.proof.generator.static.cell import (
    LAWS,
    Cell,
    World,
    contact,
    goals,
    seen,
    turned,
    world_with,
)

STEP = 1e-6  # m or rad: small against every curve, large against rounding
AXES = {"link_length": ("a", "d"), "link_twist": ("alpha", "beta")}
DRIVERS = {"backlash": ("approach", "gravity_torque")}
WHOLE = ("wrong_convention",)  # there or not: has no strength that could be small
STEPS = ("base_shift", "tool_slip", "joint_slip")
#: Laws that follow time: of the library, only these can be taken for a step, or a step for them.
IN_TIME = (*STEPS, "base_drift", "joint_drift", "thermal_growth")

Change = Callable[[Cell, World, float], tuple[Cell, World]]


def reading(cell: Cell, world: World, made: Any) -> np.ndarray:
    """(m, c) everything measured of each row, divided by its noise.

    Args:
        made: the recording, which says what was measured.
    """
    sigma = made.plan.noise
    if cell.kind == "touch":
        return (contact(cell, world)[0] - goals(cell, world)) / sigma
    points = seen(cell, world)
    if made.lengths is not None:
        return np.linalg.norm(points[:, 0], axis=1, keepdims=True) / sigma
    parts = [points.reshape(len(points), -1) / sigma]
    if made.orientations is not None:
        from app.proof.generator.static.making import ORIENTATION_SIGMA

        # a turn by a small angle changes the nine entries by sqrt(2) times that angle
        parts.append(turned(cell, world).reshape(-1, 9) / (np.sqrt(2.0) * ORIENTATION_SIGMA))
    return np.hstack(parts)


def nuisance_columns(made: Any, terms: Sequence[Term], *, geometry: bool) -> np.ndarray:
    """(m c, p) what the recording leaves open: frames, tools, targets and, if asked, all geometry."""
    cell, world = made.cell, world_with(made.cell, terms)
    columns = []
    for change in _changes(cell, geometry=geometry, known=cell.targets_known):
        ahead = reading(*change(cell, world, STEP), made)
        columns.append(((ahead - reading(cell, world, made)) / STEP).ravel())
    return np.stack(columns, axis=1)


def moved_reading(made: Any, terms: Sequence[Term], sizes: np.ndarray, *, geometry: bool) -> np.ndarray:
    """(m, c) the reading with everything that is open moved by `sizes`, in the order of `nuisance_columns`."""
    cell, world = made.cell, world_with(made.cell, terms)
    changes = _changes(cell, geometry=geometry, known=cell.targets_known)
    for change, size in zip(changes, sizes, strict=True):
        cell, world = change(cell, world, float(size))
    return reading(cell, world, made)


def term_columns(made: Any, terms: Sequence[Term], term: Term) -> np.ndarray:
    """(m c, k) a term's parameters, one column each, on top of `terms`."""
    base = reading(made.cell, world_with(made.cell, terms), made)
    names = [name for name in term.parameters if name != "mass"] if term.effect != "payload" else ["mass"]
    columns = []
    for name in names:
        only = replace(term, parameters={k: STEP if k == name else 0.0 for k in term.parameters})
        columns.append(
            ((reading(made.cell, world_with(made.cell, [*terms, only]), made) - base) / STEP).ravel()
        )
    return np.stack(columns, axis=1) if columns else np.zeros((base.size, 0))


def places(made: Any) -> Iterator[Term]:
    """Every law of the library at every place it could have in this recording; steps at the first row."""
    cell, rng = made.cell, np.random.default_rng(0)
    n = cell.arm.n
    for key, law in catalog.members(LAWS, "EFFECT").items():
        if key in WHOLE:
            continue
        options: dict[str, Sequence[Any]] = {}
        if "joint" in law.places:
            options["joint"] = range(1, n + 1)
        if "source_joint" in law.places:
            options["source_joint"] = range(1, n + 1)
        if "link" in law.places:
            options["link"] = range(1, n + 1)
        if key in AXES:
            options["axis"] = AXES[key]
        if key in DRIVERS:
            options["driver"] = DRIVERS[key]
        for chosen in product(*options.values()):
            asked = dict(zip(options, chosen, strict=True))
            if asked.get("source_joint", 0) == asked.get("joint", -1):
                continue
            try:
                term = law.draw(rng, cell, asked)
            except InputError:
                continue
            if key not in STEPS:
                yield term
                continue
            term = replace(term, where={**term.where, "from_row": 1})
            yield term
            if key == "base_shift":  # what was knocked may have turned as well
                yield replace(term, parameters={**term.parameters, "rx": 0.0, "ry": 0.0, "rz": 0.0})


def follows_time(term: Term) -> bool:
    """True of a law that a step could be taken for; of a law of no library nobody knows."""
    known = term.effect in catalog.members(LAWS, "EFFECT")
    return not known or term.effect in IN_TIME or "from_row" in term.where


def _changes(cell: Cell, *, geometry: bool, known: bool) -> Iterator[Change]:
    """Small changes of everything that is open."""
    for s in range(len(cell.tools)):
        for k in range(cell.tools.shape[1]):
            for axis in range(3):
                yield _moved("tools", (s, k, axis))
    if cell.kind == "tracker":
        for s in range(len(cell.views)):
            for axis in range(3):
                yield _moved("views", (s, axis, 3))
                yield _turned("views", s, axis)
                yield _turned("mounts", s, axis)  # moves nothing where no orientation is measured
    elif known:
        for axis in range(3):
            yield _moved("fixture", (axis, 3))
            yield _turned_fixture(axis)
    else:
        for p in range(len(cell.targets)):
            for axis in range(3):
                yield _moved("targets", (p, axis))
    if geometry:
        for link in range(1, cell.arm.n + 1):
            x, y, z = link_axes(cell.described, link)
            yield from (_placed(link, "shifts", x), _placed(link, "shifts", z))
            yield from (_placed(link, "turns", x), _placed(link, "turns", y))
            yield _zeroed(link - 1)


def _moved(name: str, index: tuple[int, ...]) -> Change:
    def change(cell, world, size):
        array = np.array(getattr(cell, name))
        array[index] += size
        return replace(cell, **{name: array}), world

    return change


def _turned(name: str, session: int, axis: int) -> Change:
    def change(cell, world, size):
        frames = getattr(cell, name).copy()
        frames[session, :3, :3] = frames[session, :3, :3] @ turn_vector(size * np.eye(3)[axis])
        return replace(cell, **{name: frames}), world

    return change


def _turned_fixture(axis: int) -> Change:
    def change(cell, world, size):
        fixture = cell.fixture.copy()
        fixture[:3, :3] = fixture[:3, :3] @ turn_vector(size * np.eye(3)[axis])
        return replace(cell, fixture=fixture), world

    return change


def _placed(link: int, name: str, direction: np.ndarray) -> Change:
    def change(cell, world, size):
        array = getattr(world, name).copy()
        array[:, link] += size * direction
        return cell, replace(world, **{name: array})

    return change


def _zeroed(joint: int) -> Change:
    def change(cell, world, size):
        dq = world.dq.copy()
        dq[:, joint] += size
        return cell, replace(world, dq=dq)

    return change
