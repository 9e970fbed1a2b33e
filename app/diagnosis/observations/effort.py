"""What a log has of the drives' effort: torques, motor currents, or the error that a servo answers with torque.

A position servo gives stiffness * (commanded - measured) less a damping torque. Without a torque column that error
stands for the torque: in newton-metres where the stiffness is stated, else in units of the stiffness, which the weight
that the description has tells. The servo's own damping is one with viscous friction, its armature with the rotor.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.wording import note
from app.errors import CellValueError, MissingColumnError
from app.recordings import Table

GAIN, STIFFNESS = "drive_gain_Nm_per_A", "servo_stiffness_Nm_per_rad"


@dataclass(frozen=True, eq=False)
class Effort:
    """Effort of each joint in the order of the file.

    Args:
        y: (m, n) [Nm]; where something is lacking [A], or [rad or m].
        lacking: header key of the factor to newton-metres that the file does not state; "" where it is torque.
        stiffness: (n,) [Nm/rad or N/m] of the servos whose error stands for torque, as stated; ones where `lacking`;
            None where torques or currents were recorded.
    """

    y: np.ndarray
    lacking: str
    stiffness: np.ndarray | None = None


def effort_of(table: Table, n: int, q: np.ndarray, commanded: np.ndarray | None, notes: list[str]) -> Effort:
    """Torques before currents before servo errors.

    Args:
        q, commanded: (m, n) measured and commanded positions in the order of the file.

    Raises:
        InputError: there is none of them, or a stated factor is no use.
    """
    joints = range(1, n + 1)
    if table.has(*[f"tau{j}" for j in joints]):
        return Effort(np.stack([table.tolerant(f"tau{j}") for j in joints], axis=1), "")
    if table.has("i1"):
        table.require([f"i{j}" for j in joints])
        return _scaled(
            table, np.stack([table.tolerant(f"i{j}") for j in joints], axis=1), GAIN, "currents", notes
        )
    if commanded is not None:
        notes.append(note("servo"))
        found = _scaled(table, commanded - q, STIFFNESS, "servo_stated", notes)
        stated = np.ones(n) if found.lacking else np.array(table.keys[STIFFNESS], float).reshape(-1)
        return replace(found, stiffness=stated)
    raise MissingColumnError(
        "neither torques, motor currents nor commanded positions for every joint",
        file=table.path,
        row=table.header_row,
        column="tau1_Nm",
        expected=f"tau1_Nm to tau{n}_Nm, i1_A to i{n}_A, or qc1_rad to qc{n}_rad",
    )


def _scaled(table: Table, y: np.ndarray, key: str, said: str, notes: list[str]) -> Effort:
    stated = table.keys.get(key)
    if stated is None:
        return Effort(y, key)
    n = y.shape[1]
    try:
        factors = np.array(stated, float).reshape(-1)
    except (TypeError, ValueError):
        factors = np.full(1, np.nan)
    if len(factors) != n or not np.all(np.isfinite(factors)) or np.any(factors == 0):
        raise CellValueError(
            f"found {str(stated)[:60]!r}",
            file=table.path,
            column=key,
            expected=f"a list of {n} numbers, none of them 0",
        )
    notes.append(note(said))
    return Effort(y * factors, "")
