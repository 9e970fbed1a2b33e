"""What the base and the tool have in common as bodies that move."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.diagnosis.models.kinematic.cell import Cell
from app.diagnosis.models.kinematic.sensitivity import Sensitivity
from app.diagnosis.result import Parameter


def base_columns(columns: Sensitivity, turning: bool) -> np.ndarray:
    """(m, k, 3 or 6) displacement of the base."""
    return columns.base if turning else columns.base[:, :, :3]


def displaced_base(cell: Cell, values: np.ndarray, driver: np.ndarray) -> Cell:
    """The cell with its base displaced by values (3 or 6) times the driver (m,)."""
    base = cell.base + np.zeros((len(driver), 1))
    base[:, : len(values)] += driver[:, None] * values
    return replace(cell, base=base)


def moved_base(cell: Cell, field: np.ndarray) -> Cell:
    """The cell with its base displaced by field (m, 3) [m], row by row."""
    base = cell.base + np.zeros((len(field), 1))
    base[:, :3] += field
    return replace(cell, base=base)


def size(parameters: tuple[Parameter, ...]) -> str:
    """Length of the displacement, and its turn where there is one."""
    shift = float(np.linalg.norm([p.value for p in parameters[:3]]))
    text = f"{shift:.3g} {parameters[0].unit}"
    if len(parameters) > 3:
        turn = float(np.linalg.norm([p.value for p in parameters[3:]]))
        text += f" and {turn:.3g} {parameters[3].unit}"
    return text
