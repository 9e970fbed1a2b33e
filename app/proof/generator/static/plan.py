"""How a static recording is made."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Plan:
    """How a recording is made; lengths in metres.

    Args:
        kind: touch or tracker.
        samples: rows.
        noise: one-sigma of each axis.
        noise_kind: see noise.py.
        outliers: share of rows that went wrong.
        stated: False leaves the noise out of the header.
        sessions: number of set-ups, each with its own instrument frame and tool.
        reflectors: points on the tool, 1 to 3 (tracker).
        orientation: the tracker gives orientation too.
        wire: only the length of a draw-wire is measured.
        targets: touched points (touch).
        known_targets: their coordinates are in the file.
        repeats: rows that repeat a pose at once.
        loads_kg: declared loads, taken in turns over the rows.
        torque_sensors: joint torques are recorded.
        declares_compliance: the file states every joint's compliance.
        effect_rms: what an effect does to the tool point where its strength is left open.
        repeats_as: "at_once" (a pose again in the next row), "apart" (again some rows later, come to from elsewhere) or
            "either_side" (each repeated pose is come to from a row on one side of it, and later from the other).
        scatter: how far a repeated pose misses itself [rad or m].
        labelled: False leaves the column that tells repeated poses out.
        in_turns: touched points are visited in turns, not one after the other (touch).
        unseen: share of rows that are reached by way of a point the file does not tell.
        lean: how far the base leans against what the description says [rad], one sigma about x and y.
        settling: rows a step takes until it is whole.
        shuffled: rows stand in the file in another order than they were taken; the time tells it.
    """

    kind: str = "tracker"
    samples: int = 60
    noise: float = 0.15e-3
    noise_kind: str = "gaussian"
    outliers: float = 0.0
    stated: bool = True
    sessions: int = 1
    reflectors: int = 1
    orientation: bool = False
    wire: bool = False
    targets: int = 5
    known_targets: bool = False
    repeats: int = 0
    loads_kg: tuple[float, ...] = ()
    torque_sensors: bool = False
    declares_compliance: bool = False
    effect_rms: float = 0.8e-3
    repeats_as: str = "at_once"
    scatter: float = 0.0
    labelled: bool = True
    in_turns: bool = False
    unseen: float = 0.0
    lean: float = 0.0
    settling: int = 0
    shuffled: bool = False
