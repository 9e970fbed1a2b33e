"""Numbers read under the wrong unit or convention: the others are tried, and the one under which the residual vanishes
is named.

Lengths in the wrong unit scale everything alike and leave no residual; they show by their size.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture
from app.calibration.points import Points
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.solvers.joint import fit_joint
from app.calibration.wording import Phrase, phrase, remark
from app.errors import DegenerateGeometryError
from app.geometry import CONVENTIONS, rot_x, rot_y, rot_z
from app.units import DEG_PER_RAD, from_mm, mm

#: Residuals below this are no reason to doubt the convention [m].
FINE = from_mm(1.5)
#: Another reading must leave at most this share of the residual.
VANISHES = 0.2
#: No arm holds its flange further from its base, and no workshop moves it by less [m].
_FAR, _NEAR = 20.0, from_mm(5.0)


@dataclass(frozen=True)
class ConventionCheck:
    key: str = "convention"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        points: Points | None = context.get("points")
        if points is None or not len(result.residual_vectors):
            return []
        return [*_lengths(points), *self._angles(points, result)]

    def _angles(self, points: Points, result: ToolCalibration) -> list[Warning_]:
        if result.sigma < FINE:
            return []
        rows = [i for i, c in enumerate(points.captures) if "touch" in c.roles]
        values = points.written.values[rows]
        best_name, best = phrase("reading.inverse"), result.sigma
        for name, rotations, positions in _readings(points, values):
            try:
                sigma = fit_joint(rotations, positions).sigma
            except DegenerateGeometryError:
                continue
            if sigma < best:
                best_name, best = name, sigma
        if best > VANISHES * result.sigma:
            return []
        return [remark(self.key, severe=True, reading=best_name, best=mm(best), found=mm(result.sigma))]


CHECK = ConventionCheck()


def _lengths(points: Points) -> list[Warning_]:
    if points.written.convention is None:
        return []
    positions = np.array([c.T_base_flange.position for c in points.captures])
    far, spread = float(np.abs(positions).max()), float(np.ptp(positions, axis=0).max())
    unit = points.written.names[0].rpartition("_")[2]
    if far > _FAR and unit == "m":
        return [remark("units", "units_m", severe=True, far=far)]
    if far < _NEAR and spread > 0 and unit == "mm":
        return [remark("units", "units_mm", severe=True, far=mm(far))]
    return []


def _readings(points: Points, values: np.ndarray) -> Iterator[tuple[Phrase, np.ndarray, np.ndarray]]:
    """Name, rotations, positions of every other way to read the numbers."""
    written = points.written
    units = {
        "deg": (phrase("reading.radians"), DEG_PER_RAD),
        "rad": (phrase("reading.degrees"), 1.0 / DEG_PER_RAD),
    }
    unit = written.names[-1].rpartition("_")[2]
    if written.convention is None:
        if unit in units:
            name, factor = units[unit]
            poses = written.poses(values * factor)
            yield name, poses[:, :3, :3], poses[:, :3, 3]
        return
    numbers, positions = values[:, 3:], values[:, :3]
    if not written.convention.angular:
        swapped = CONVENTIONS["quaternion"].to_rotation(numbers[:, [3, 0, 1, 2]])
        yield phrase("reading.w_last"), swapped, positions
        yield phrase("reading.inverse"), _turned_round(written.poses(values)), positions
        return
    for key, form in (*((k, c.to_rotation) for k, c in CONVENTIONS.items() if c.angular), *_OTHERS.items()):
        if key != written.convention.key:
            yield _title(key), form(numbers), positions
        name, factor = units[unit]
        both = name if key == written.convention.key else phrase("reading.both", form=_title(key), unit=name)
        yield both, form(numbers * factor), positions
    yield phrase("reading.inverse"), _turned_round(written.poses(values)), positions


def _turned_round(poses: np.ndarray) -> np.ndarray:
    return np.swapaxes(poses[:, :3, :3], 1, 2)


def _title(key: str) -> Phrase:
    if key in CONVENTIONS:
        return phrase("reading.of", name=key, makers=", ".join(CONVENTIONS[key].makers))
    return phrase(f"reading.{key}")


_OTHERS: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "staubli": lambda a: rot_x(a[..., 0]) @ rot_y(a[..., 1]) @ rot_z(a[..., 2]),
}
