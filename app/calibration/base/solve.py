"""Arcs -> BaseCalibration: the one road that command, pendant and tests take."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.calibration.base.arcfit import ArcFit, fit_arcs
from app.calibration.base.arcs import Arcs
from app.calibration.base.checks import look
from app.calibration.base.frame import base_frames
from app.calibration.base.maker import maker_frame
from app.calibration.base.result import BaseCalibration
from app.calibration.base.wording import phrase
from app.calibration.base.zero import zero_place
from app.geometry import Pose
from app.kinematics import RobotModel
from app.phrases import Phrase
from app.units import from_um

SMALLEST_NOISE = from_um(
    0.1
)  # no tracker is better; keeps made-up recordings without noise from claiming zero
#: Share of the radius below which the middle of an arc no longer tells which side the work space is on.
_UNCLEAR_SHARE = 0.02
_UNCLEAR_STATED = 1e-3  # m, the same for a point that was written down


def solve_base(source: Arcs, robot: RobotModel | None = None) -> BaseCalibration:
    """The base frame of one robot with its uncertainty and everything the checks have to say.

    Args:
        source: arcs of axis 1 and axis 2, and of others if they were turned.
        robot: the description, for the step to the maker's frame; None leaves that out.

    Raises:
        TooFewPointsError, DegenerateGeometryError: the arcs cannot give the frame; `code` says which check.
    """
    arcs = list(source.arcs.values())
    warnings = [w for arc in arcs for w in look("points", arc)]
    floor = max(source.floor, SMALLEST_NOISE)
    fitted = fit_arcs(arcs, [source.sigma(a.points) for a in arcs], floor)
    for found in fitted:
        warnings += look("arc", found)
    by_axis = {found.arc.axis: found for found in fitted}
    base = _frame(source, by_axis)
    base = replace(base, zero=zero_place(base))
    if robot is not None:
        base = replace(base, maker=maker_frame(base, robot))
    warnings += look("frame", base)
    ordered = sorted(warnings, key=lambda w: not w.severe)
    return replace(base, warnings=tuple(ordered), notes=_notes(base))


def _frame(source: Arcs, by_axis: dict[int, ArcFit]) -> BaseCalibration:
    first, second = by_axis[1], by_axis[2]
    if source.towards is not None:
        towards, unclear = source.towards, _UNCLEAR_STATED
    else:
        towards = first.arc.points[first.used].mean(axis=0)
        unclear = _UNCLEAR_SHARE * first.radius
    one, two = first.axes, second.axes
    sine = float(np.linalg.norm(np.cross(one.direction, two.direction)))
    look("parallel", sine)
    f = base_frames(one, two, towards, unclear=unclear)
    return BaseCalibration(
        source,
        Pose(f.matrices),
        f.covariance,
        first,
        second,
        float(f.offset),
        float(f.offset_sigma),
        float(f.angle),
        float(f.angle_sigma),
        float(f.axis2_along_y),
        towards,
        others=tuple(found for axis, found in sorted(by_axis.items()) if axis > 2),
    )


def _notes(base: BaseCalibration) -> tuple[Phrase, ...]:
    notes = []
    if base.source.towards is None:
        notes.append(phrase("note.towards"))
    silent = [found.arc.axis for found in base.arcs if found.arc.angles is None]
    if silent:
        axes: object = silent[0]
        for axis in silent[1:]:
            axes = phrase("list.two", first=axes, second=axis)
        notes.append(phrase("note.no_angles", axes=axes))
    return tuple(notes)
