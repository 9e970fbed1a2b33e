"""Columns of a plain CSV under names of its own: `q=joint*_pos:deg,tau=torque,t=time:ms`.

A quantity that every joint has is named by what its columns share: `torque` stands for torque1, torque_2, torque[3] …,
counted from 0 or from 1; a star stands where the number is, or the joint's name. The mapping comes from `--map` or from
a line `# map:` above the header row.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from app.errors import FileFormatError, UnknownNameError
from app.recordings.mapping import A_JOINT, check_unit, unit_of
from app.recordings.options import ReadOptions

_COUNTED = r"[\s_.:\[({]*(\d+)[\])}]*"


def renamed_columns(
    names: tuple[str, ...], mapping: Mapping[str, str], options: ReadOptions, path: Path
) -> tuple[str, ...]:
    """The columns' names as this program has them; those that no mapping names stay.

    Args:
        names: as they stand in the file.
        mapping: quantity -> name, with a unit behind a colon; without one it is SI.
        options: the robot's joints, which a star may stand for.
        path: for messages.

    Raises:
        UnknownNameError: a name that no column has.
        FileFormatError: joints that are not counted on from 0 or 1.
        InputError: a unit that the quantity does not come in.
    """
    new = dict(zip(names, names, strict=True))
    for quantity, text in mapping.items():
        name, _, unit = text.rpartition(":") if ":" in text and text not in names else (text, "", "")
        if quantity in A_JOINT:
            columns = _of_joints(names, name, options, path)
        else:
            columns = [_single(names, name, path)]
        for number, column in enumerate(columns, 1):
            full = f"{quantity}{number}" if quantity in A_JOINT else quantity
            slides = number <= len(options.slides) and options.slides[number - 1]
            usual = unit_of(quantity, slides=slides)
            said = usual if not unit or (slides and not unit.startswith("m")) else unit
            if said:
                check_unit(full, said, path)
            new[column] = f"{full}_{said}" if said else full
    kept = {old: name for old, name in new.items() if old == name}
    for old, name in new.items():  # a column of the file that happens to bear the new name makes room
        if old != name and name in kept:
            new[name] = f"recorded as {name}"
    return tuple(new[name] for name in names)


def _single(names: tuple[str, ...], name: str, path: Path) -> str:
    if name not in names:
        raise UnknownNameError(name, available=names, what="column", file=path)
    return name


def _of_joints(names: tuple[str, ...], name: str, options: ReadOptions, path: Path) -> list[str]:
    """The joints' columns in their order."""
    if name in names:
        return [name]
    if "*" in name and options.joint_names:
        by_name = [name.replace("*", joint) for joint in options.joint_names]
        if all(column in names for column in by_name):
            return by_name
    front, star, back = name.partition("*")
    pattern = re.compile(
        re.escape(front) + r"(\d+)" + re.escape(back) if star else re.escape(front) + _COUNTED, re.IGNORECASE
    )
    found = {int(match.group(1)[:6]): n for n in names if (match := pattern.fullmatch(n.strip()))}
    if not found:
        raise UnknownNameError(name, available=names, what="columns", file=path)
    numbers = sorted(found)
    if numbers[0] > 1 or numbers != list(range(numbers[0], numbers[0] + len(numbers))):
        raise FileFormatError(
            f"columns {name} are counted {', '.join(map(str, numbers[:12]))}",
            file=path,
            column=found[numbers[0]],
            expected="0, 1, 2 … or 1, 2, 3 …",
        )
    return [found[number] for number in numbers]
