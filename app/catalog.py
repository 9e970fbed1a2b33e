"""Finds modes, effects, formats, commands and robots by listing the folders they live in.

Adding one is adding a file: nothing else has a list of them.
"""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

from app.errors import UnknownNameError


@cache
def modules(package: str) -> dict[str, ModuleType]:
    """Member modules of a package by their file name, in the order of their names."""
    root = importlib.import_module(package)
    names = sorted(info.name for info in pkgutil.iter_modules(root.__path__) if not info.name.startswith("_"))
    return {name: importlib.import_module(f"{package}.{name}") for name in names}


def module_names(package: str) -> list[str]:
    """File names of a package's members, without importing them."""
    root = importlib.import_module(package)
    return sorted(info.name for info in pkgutil.iter_modules(root.__path__) if not info.name.startswith("_"))


@cache
def members(package: str, attribute: str) -> dict[str, Any]:
    """The object called `attribute` of every module in `package`, by its own `key`.

    Modules without it (the family's shared code) are passed over.
    """
    found = {}
    for module in modules(package).values():
        member = getattr(module, attribute, None)
        if member is not None:
            found[member.key] = member
    return found


def member(package: str, attribute: str, key: str, *, what: str) -> Any:
    """One member by key.

    Raises:
        UnknownNameError: no member has this key; lists those that are there.
    """
    family = members(package, attribute)
    if key not in family:
        raise UnknownNameError(key, available=family, what=what)
    return family[key]


def folders(root: Path, marker: str) -> dict[str, Path]:
    """Sub-folders that hold a file called `marker`, by folder name."""
    return {path.parent.name: path.parent for path in sorted(root.glob(f"*/{marker}"))}
