"""The saved model: what was found, as data that the simulation, the pendant and the diagnosis load.

A model never holds code or truth: effect keys, places and values, in SI units.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec

from app.diagnosis.result import Diagnosis
from app.errors import FileFormatError, InputError
from app.files import read_bytes, write_bytes
from app.typed import learnt

FORMAT = "teachframe.model/1"
#: A model with the targets of a long recording is a few megabytes [bytes].
LARGEST_FILE = 50_000_000


class ModelEffect(msgspec.Struct, frozen=True):
    """One effect with its values.

    Args:
        effect: its key.
        where: its place, as in a finding.
        parameters: values by name, SI; those that begin with `fixed_` choose the law's form.
        named: False for what is part of the fit without being a finding: members of families, unnamed parts.
        fades: True for what holds only between the joint ranges of `Taught`; rows that go elsewhere are predicted
            without it.
        along: the joint (from 1) whose range alone counts for that; 0 for all joints.
        near: True where it fades away from the poses of `Taught` as well, within the ranges too.
    """

    effect: str
    where: dict[str, Any]
    parameters: dict[str, float]
    named: bool = True
    fades: bool = False
    along: int = 0
    near: bool = False


class Taught(msgspec.Struct, frozen=True):
    """Where a model was learnt: away from there its unnamed parts fade out.

    Args:
        lowest, highest: range of each joint in the recording [rad or m].
        still: numbers of joints that never moved; nothing is known of them.
        poses: some of the recorded joint positions, spread over all of them [rad or m].
        rows: fingerprint of the rows it was learnt from.
        heldout_rms: held-out error there, everything refitted on the rows kept; in `unit`.
    """

    lowest: list[float] = []
    highest: list[float] = []
    still: list[int] = []
    poses: list[list[float]] = []
    rows: str = ""
    heldout_rms: float = 0.0
    unit: str = ""


class SavedModel(msgspec.Struct, frozen=True):
    """Effects on top of a robot's description.

    Args:
        format: always teachframe.model/1.
        kind: "static" or "motion".
        robot: name or path of the robot it was found on.
        effects: what is applied, in order.
        nuisance: fitted base, tool and targets by name [m, rad], for a repeat of the same recording.
        source: the recording it was learnt from.
        taught: where it was learnt.
    """

    kind: str
    robot: str
    effects: tuple[ModelEffect, ...] = ()
    nuisance: dict[str, list[float]] = {}
    source: str = ""
    taught: Taught = Taught()
    format: str = FORMAT

    def to_dict(self) -> Mapping[str, Any]:
        return msgspec.to_builtins(self)


_MODEL = learnt(SavedModel)


def model_of(diagnosis: Diagnosis) -> SavedModel:
    """The findings of a diagnosis as a model.

    Raises:
        InputError: the diagnosis carries none.
    """
    if not diagnosis.model:
        raise InputError(
            "nothing was found that could be saved as a model", file=diagnosis.file, expected="a finding"
        )
    return msgspec.convert(dict(diagnosis.model), SavedModel)


def save_model(model: SavedModel, path: str | Path) -> None:
    """Writes a model as JSON, whole or not at all; raises FileFormatError where it cannot be written."""
    write_bytes(path, msgspec.json.format(msgspec.json.encode(model), indent=2) + b"\n")


def load_model(path: str | Path) -> SavedModel:
    """Reads a model.

    Raises:
        FileFormatError: not such a file.
        InputError: a place or a number in it that cannot be.
    """
    from app.diagnosis.model_checks import checked

    data = read_bytes(path, LARGEST_FILE, FORMAT)
    try:
        model = _MODEL.decode(data)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise FileFormatError(f"not a saved model ({error})", file=path, expected=FORMAT) from None
    if model.format != FORMAT:
        raise FileFormatError(f"its format is {model.format[:40]!r}", file=path, expected=FORMAT)
    return checked(model, path)
