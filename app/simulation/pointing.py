"""Where a careful hand brings the tip for points of a wizard that are neither touches of the spike nor strokes.

Each is a pose of the tip in base, T_base_tip, without the hand's error; the best comes first, and whoever asks takes
the first that the arm reaches and that nothing hinders.

    spin      the tip stays on the spike, the tool turns about its own axis
    minus_x   a point of the tool's -X comes to the spike
    xy        a point of the tool's XY plane with +Y comes to the spike
    world     the tool's axes stand parallel to the base's
    plane     the tip comes to the plate, tilted another way each time
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from app.calibration.modes.abc_world import R_WORLD
from app.geometry import Pose, exp_so3, rot_z
from app.simulation.world import World
from app.units import from_deg, from_mm

#: Roles that this file knows.
POINTED = frozenset({"spin", "minus_x", "xy", "world", "plane"})
_SHOWN = {"minus_x": (-1.0, 0.0, 0.0), "xy": (0.3, 1.0, 0.0)}  # the point shown, in the tool
_SHOWN_LENGTH = from_mm(120.0)
_TURNS = from_deg(np.array([60.0, -60.0, 45.0, -45.0, 90.0, -90.0, 120.0, -120.0, 30.0, -30.0]))
_APART = from_deg(29.0)  # two spins differ by more
_LEANS = from_deg(np.array([0.0, 20.0, 35.0]))
_AROUND = 6
#: In turn nearly upright and far over: touches that are all tilted by the same angle leave the tool's length open, for
#: another length is another plate. Nine of them at 0.15 mm leave 1.1 mm (95%) with 15 and 55 degrees, and 7 mm with
#: 28 to 45.
_PLATE_TILTS = (from_deg(np.array([15.0, 8.0, 20.0, 0.0])), from_deg(np.array([55.0, 50.0, 45.0, 40.0])))
_GOLDEN = 2.4  # rad: so many turns about the upright later, the tilt has come back nowhere near any before it
_BESIDE = from_mm(140.0)  # from the spike to where the plate is touched
_PLACES = 8

Blocked = Callable[[np.ndarray], object]


def aims(
    world: World, role: str, q: np.ndarray, made: Sequence[np.ndarray], blocked: Blocked
) -> Iterator[Pose]:
    """Poses of the tip for one more point, the best first.

    Args:
        world: whose tip and spike.
        role: one of `POINTED`.
        q: (n,) where the arm stands [rad or m].
        made: joint positions of the points of this role that are recorded.
        blocked: joint positions -> true where something would be hit.
    """
    if role == "spin":
        yield from _spins(world, q, made, blocked)
    elif role == "world":
        for place in _places_before(world):
            yield Pose.of(R_WORLD, place)
    elif role == "plane":
        yield from _on_plate(world, len(made))
    else:
        point = np.array(_SHOWN[role])
        point *= _SHOWN_LENGTH / np.linalg.norm(point)
        for rotation in _orientations(world, q):
            yield Pose.of(rotation, world.p_base_spike - rotation @ point)


def _orientations(world: World, q: np.ndarray) -> Iterator[np.ndarray]:
    """R_base_tip: as the tip stands, as it stands at home, and leant and turned from there."""
    yield world.tip(q).rotation
    upright = world.tip(world.robot.home).rotation
    for lean in _LEANS:
        for around in np.arange(_AROUND if lean else 1) * (2.0 * np.pi / _AROUND):
            tilted = exp_so3(lean * np.array([np.cos(around), np.sin(around), 0.0])) @ upright
            for turn in (0.0, *_TURNS):
                yield tilted @ rot_z(turn)


def _spins(world: World, q: np.ndarray, made: Sequence[np.ndarray], blocked: Blocked) -> Iterator[Pose]:
    """About one axis: the first one stands where two more can follow."""
    spike = world.p_base_spike
    if made:
        first = world.tip(made[0]).rotation
        turned = [_about_z(first, world.tip(other).rotation) for other in made]
        for turn in _TURNS:
            if min(abs(turn - other) for other in turned) > _APART:
                yield Pose.of(first @ rot_z(turn), spike)
        return
    for rotation in _orientations(world, q):
        turns: list[float] = []
        for turn in _TURNS:
            if all(abs(turn - other) > _APART for other in (0.0, *turns)):
                found = world.bring(q, Pose.of(rotation @ rot_z(turn), spike))
                turns += [turn] if found.reached and not blocked(found.q) else []
            if len(turns) == 2:
                yield Pose.of(rotation, spike)
                break


def _about_z(first: np.ndarray, other: np.ndarray) -> float:
    step = first.T @ other
    return float(np.arctan2(step[1, 0] - step[0, 1], step[0, 0] + step[1, 1]))


def _places_before(world: World) -> Iterator[np.ndarray]:
    """(3,) places over the table, the nearest to the spike first."""
    reach = float(world.robot.description.get("reach_m", world.robot.reach))
    spike = world.p_base_spike
    away = np.array([*(spike[:2] / np.linalg.norm(spike[:2])), 0.0])
    side = np.array([-away[1], away[0], 0.0])
    steps = [
        (up, back, aside)
        for up in (0.1, 0.25, 0.4, 0.6)
        for back in (0.0, 0.12, -0.12, 0.25)
        for aside in (0.0, 0.2, -0.2)
    ]
    for up, back, aside in sorted(steps, key=lambda step: sum(abs(v) for v in step)):
        yield spike + reach * (up * np.array([0.0, 0.0, 1.0]) - back * away + aside * side)


def _on_plate(world: World, number: int) -> Iterator[Pose]:
    """Tilted by a golden angle further each time, at a place beside the spike that can be reached so."""
    at_home = world.tip(world.robot.home).rotation
    axis = np.cross(at_home[:, 2], [0.0, 0.0, -1.0])
    sine = float(np.linalg.norm(axis))
    upright = exp_so3(axis / sine * np.arctan2(sine, -at_home[2, 2])) @ at_home if sine > 1e-9 else at_home
    around = _GOLDEN * number
    for tilt in _PLATE_TILTS[number % 2]:
        lean = exp_so3(tilt * np.array([np.cos(around), np.sin(around), 0.0]))
        for k in range(_PLACES):
            beside = _GOLDEN * number + k * (2.0 * np.pi / _PLACES)
            place = np.array([*world.p_base_spike[:2], world.plate_height])
            place[:2] += _BESIDE * np.array([np.cos(beside), np.sin(beside)])
            for turn in (0.0, 0.8, -0.8, 1.6, -1.6):
                yield Pose.of(lean @ upright @ rot_z(turn), place)
