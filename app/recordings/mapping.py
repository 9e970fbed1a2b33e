"""Arrays under names of their own, made a recording by a mapping: `q=positions:deg,tau=effort,t=time:ms`.

A quantity is q, qd, qc, theta, tau, i or temperature (one number a joint), or any single column of a recording (t,
target, payload, x …, xyz for three). A unit stands behind a colon; without one it is SI (rad, m for sliding joints, Nm,
A, s). Names that are usual are found without a mapping.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from app.errors import FileFormatError, InputError, UnknownNameError
from app.phrases import Said
from app.recordings.columns import units_of
from app.recordings.formats._frames import table_of
from app.recordings.options import ReadOptions
from app.recordings.table import Table
from app.recordings.wording import phrase

#: Quantity -> its unit, where none is said; turning joints.
A_JOINT = {
    "q": "rad",
    "qd": "rad_s",
    "qc": "rad",
    "theta": "rad",
    "tau": "Nm",
    "i": "A",
    "temperature": "degC",
}
_SLIDING = {"q": "m", "qd": "m_s", "qc": "m", "tau": "Nm"}
_SINGLE = {"t": "s", "payload": "kg", "length": "m", "x": "m", "y": "m", "z": "m"}
#: What is usually meant, by the last part of a name in small letters.
_USUAL = {
    "t": ("t", "time", "timestamp", "timestamps", "ts", "t_s"),
    "q": ("q", "qpos", "position", "positions", "joint_position", "joint_positions", "observation.state", "state"),
    "qd": ("qd", "dq", "qvel", "velocity", "velocities", "joint_velocity", "joint_velocities"),
    "tau": ("tau", "torque", "torques", "effort", "efforts", "joint_torque", "joint_torques"),
    "i": ("i", "current", "currents", "motor_current", "motor_currents"),
    "qc": ("qc", "q_cmd", "q_des", "commanded", "action"),
}  # fmt: skip
_MOST_LISTED = 12


def recording_of(
    path: Path,
    arrays: Mapping[str, np.ndarray],
    options: ReadOptions,
    *,
    stated: Mapping[str, str] | None = None,
    names: Mapping[str, tuple[str, ...]] | None = None,
) -> Table:
    """The recording that arrays hold.

    Args:
        path: the file, for messages.
        arrays: name -> (m,) or (m, k) numbers; (k, m) is turned where the others have m rows.
        options: the mapping that was asked for, and the robot's joints.
        stated: a mapping that the file itself holds.
        names: name of an array -> what its columns are called, where the file says.

    Raises:
        UnknownNameError: a mapping that names no array.
        FileFormatError: nothing that could be joint angles, or arrays of different lengths.
    """
    mapping = {**(stated or {}), **options.mapping}
    chosen = {q: _named(v, arrays, path) for q, v in mapping.items() if q != "points"}
    for quantity, usual in _USUAL.items():
        if quantity not in chosen and (found := _usual(arrays, usual)) is not None:
            chosen[quantity] = (found, None)
    if "q" not in chosen:
        raise FileFormatError(
            f"which of these are the joints' angles: {_listed(arrays)}?",
            file=path,
            expected="--map q=NAME,tau=NAME",
        )
    rows = max(arrays[chosen["q"][0]].shape)
    columns: dict[str, np.ndarray] = {}
    for quantity, (name, unit) in chosen.items():
        values = _rows_first(arrays[name], rows, name, path)
        picked = _picked(values, (names or {}).get(name), options, quantity)
        columns |= _columns(quantity, values[:, picked], unit, options, path)
    if not any(key.startswith("t_") for key in columns):
        raise FileFormatError(
            f"no time among {_listed(arrays)}", file=path, expected="--map t=NAME, with its unit as t=NAME:ms"
        )
    has = {key.rpartition("_")[0] for key in columns}
    keys: dict[str, Any] = {"kind": "tracker" if "x" in has else "motion"}
    said = ", ".join(f"{q} = {name}" for q, (name, _) in chosen.items())
    table = table_of(path, keys, columns)
    return Table(path, keys, table.names, table.load, notes=(Said(phrase("mapped", pairs=said)),))


def _named(text: str, arrays: Mapping[str, np.ndarray], path: Path) -> tuple[str, str | None]:
    name, _, unit = text.rpartition(":") if ":" in text and text not in arrays else (text, "", "")
    ends = [key for key in arrays if key == name or key.endswith("/" + name) or key.endswith("." + name)]
    if name not in arrays and len(ends) != 1:
        raise UnknownNameError(name, available=arrays, what="array", file=path)
    return (name if name in arrays else ends[0]), unit or None


def _usual(arrays: Mapping[str, np.ndarray], usual: tuple[str, ...]) -> str | None:
    for wanted in usual:
        found = [
            key
            for key in arrays
            if key.lower() == wanted or key.lower().replace("/", ".").endswith("." + wanted)
        ]
        if len(found) == 1:
            return found[0]
    return None


def _listed(arrays: Mapping[str, np.ndarray]) -> str:
    shown = [f"{k} {'x'.join(map(str, v.shape))}" for k, v in list(arrays.items())[:_MOST_LISTED]]
    return ", ".join(shown) + (" …" if len(arrays) > _MOST_LISTED else "")


def _rows_first(values: np.ndarray, rows: int, name: str, path: Path) -> np.ndarray:
    """(rows, k)."""
    values = values.reshape(-1, 1) if values.ndim == 1 else values
    if values.ndim == 2 and values.shape[0] != rows and values.shape[1] == rows:
        values = values.T
    if values.ndim != 2 or values.shape[0] != rows:
        shape = "x".join(map(str, values.shape))
        raise FileFormatError(
            f"array {name} is {shape}", file=path, column=name, expected=f"{rows} rows as the joints"
        )
    return values


def _picked(
    values: np.ndarray, names: tuple[str, ...] | None, options: ReadOptions, quantity: str
) -> list[int]:
    """Which columns belong to the robot's joints: by name where there are names, else all."""
    every = list(range(values.shape[1]))
    wanted = options.joint_names
    if quantity not in A_JOINT or not wanted or names is None or len(names) != len(every):
        return every
    bare = [name.removesuffix(".pos").removesuffix(".vel").removesuffix(".effort") for name in names]
    prefix = options.prefix or ""
    at = [next((k for k, name in enumerate(bare) if name in (w, prefix + w)), None) for w in wanted]
    return [int(k) for k in at if k is not None] if None not in at else every


def _columns(
    quantity: str, values: np.ndarray, unit: str | None, options: ReadOptions, path: Path
) -> dict[str, np.ndarray]:
    if quantity in A_JOINT:
        slides = options.slides if len(options.slides) == values.shape[1] else (False,) * values.shape[1]
        usual = [unit_of(quantity, slides=s) for s in slides]
        units = usual if unit is None else [unit if not s or unit in ("m", "mm") else "m" for s in slides]
        for u in units:
            check_unit(f"{quantity}1", u, path)
        return {f"{quantity}{j}_{u}": values[:, j - 1] for j, u in enumerate(units, 1)}
    if quantity == "xyz":
        check_unit("x", unit or "m", path)
        return {f"{axis}_{unit or 'm'}": values[:, k] for k, axis in enumerate("xyz"[: values.shape[1]])}
    if values.shape[1] != 1:
        raise InputError(
            f"--map {quantity} names {values.shape[1]} columns", file=path, expected="one column"
        )
    if units_of(quantity) is None:
        return {quantity: values[:, 0]}
    unit = unit or unit_of(quantity)
    check_unit(quantity, unit, path)
    return {f"{quantity}_{unit}": values[:, 0]}


def unit_of(quantity: str, *, slides: bool = False) -> str:
    """The unit a quantity has where none is said; empty for text and pure numbers."""
    if quantity in A_JOINT:
        return (_SLIDING if slides else A_JOINT).get(quantity, A_JOINT[quantity])
    if units_of(quantity) is None:
        return ""
    return _SINGLE.get(quantity) or {"mm": "m", "deg": "rad"}.get((units_of(quantity) or ("",))[0], "")


def check_unit(quantity: str, unit: str, path: Path) -> None:
    """Raises InputError where the quantity does not come in that unit."""
    allowed = units_of(quantity) or ()
    if unit not in allowed:
        raise InputError(
            f"--map says {unit or 'no unit'} for {quantity}",
            file=path,
            expected="one of " + ", ".join(allowed),
        )
