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

FORMAT = "teachframe.model/1"


class ModelEffect(msgspec.Struct, frozen=True):
    """One effect with its values."""

    effect: str
    where: dict[str, Any]
    parameters: dict[str, float]


class SavedModel(msgspec.Struct, frozen=True):
    """Effects on top of a robot's description.

    Args:
        format: always teachframe.model/1.
        kind: "static" or "motion".
        robot: name or path of the robot it was found on.
        effects: what is applied, in order.
        nuisance: fitted base, tool and targets by name [m, rad], for a repeat of the same recording.
        source: the recording it was learnt from.
    """

    kind: str
    robot: str
    effects: tuple[ModelEffect, ...] = ()
    nuisance: dict[str, list[float]] = {}
    source: str = ""
    format: str = FORMAT

    def to_dict(self) -> Mapping[str, Any]:
        return msgspec.to_builtins(self)


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
    """Writes a model as JSON, whole or not at all."""
    path = Path(path)
    temporary = path.with_name(path.name + ".part")
    temporary.write_bytes(msgspec.json.format(msgspec.json.encode(model), indent=2) + b"\n")
    temporary.replace(path)


def load_model(path: str | Path) -> SavedModel:
    """Reads a model.

    Raises:
        FileFormatError: not such a file.
    """
    try:
        model = msgspec.json.decode(Path(path).read_bytes(), type=SavedModel)
    except OSError as error:
        raise FileFormatError(f"cannot be read ({error.strerror})", file=path) from None
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise FileFormatError(f"not a saved model ({error})", file=path, expected=FORMAT) from None
    if model.format != FORMAT:
        raise FileFormatError(f"its format is {model.format!r}", file=path, expected=FORMAT)
    return model
