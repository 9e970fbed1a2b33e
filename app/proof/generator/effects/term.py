"""One effect at one place with its values, and how one is asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

import numpy as np

from app import catalog
from app.errors import InputError
from app.units import SI_FACTORS

#: Options that say where; the rest are sizes.
PLACES = ("joint", "source_joint", "link", "axis", "driver", "order", "from_row", "from_s", "to_s")
WHOLE = ("joint", "source_joint", "link", "order", "from_row")


@dataclass(frozen=True)
class Size:
    """A parameter of a law: its name, the SI unit it has inside, and the unit a person gives it in."""

    name: str
    unit: str
    given_in: str = ""

    @property
    def factor(self) -> float:
        return SI_FACTORS.get(self.given_in, 1.0)


@dataclass(frozen=True)
class Term:
    """An effect at a place, with values in SI.

    Args:
        effect: key.
        where: as the contract of the diagnosis names places.
        parameters: by name, SI.
        scalable: False where the strength is not a number (a sign that is wrong).
    """

    effect: str
    where: Mapping[str, Any]
    parameters: Mapping[str, float]
    scalable: bool = True

    def times(self, factor: float) -> Term:
        return replace(self, parameters={k: v * factor for k, v in self.parameters.items()})


def same_place(a: Term, b: Term) -> bool:
    """The same law at the same place; a step's row does not count, and one wave a turn goes without saying."""
    told = [{"order": 1, **term.where, "from_row": 0} for term in (a, b)]
    return a.effect == b.effect and told[0] == told[1]


class Law(Protocol):
    """What every file under effects/ holds as `EFFECT`."""

    key: str
    places: tuple[str, ...]
    sizes: tuple[Size, ...]

    def draw(self, rng: np.random.Generator, cell: Any, asked: Mapping[str, Any]) -> Term:
        """A term of realistic shape; `asked` fixes what the caller wants."""
        ...

    def add(self, cell: Any, term: Term, world: Any) -> None:
        """Adds the term to the world the recording is made in."""
        ...


@dataclass(frozen=True)
class Request:
    """What was asked for: a law, places, and sizes in SI (empty: draw them)."""

    effect: str
    places: Mapping[str, Any] = field(default_factory=dict)
    sizes: Mapping[str, float] = field(default_factory=dict)


def parse_request(text: str, package: str) -> Request:
    """Reads `NAME` or `NAME:joint=2,axis=a,size=0.3`; several sizes stand as `size=1/0.5/0`.

    Raises:
        UnknownNameError: no such effect in `package`.
        InputError: an option the effect does not have, or a value that is none.
    """
    name, _, rest = text.partition(":")
    law = catalog.member(package, "EFFECT", name.strip(), what="effect")
    known = (*law.places, *(s.name for s in law.sizes), *(("size",) if law.sizes else ()))
    places: dict[str, Any] = {}
    sizes: dict[str, float] = {}
    for part in filter(None, (p.strip() for p in rest.split(","))):
        key, equals, value = (piece.strip() for piece in part.partition("="))
        if key not in known or not equals:
            expected = ", ".join(f"{k}=" for k in known) or "no options"
            raise InputError(f"effect {law.key} has no option {part!r}", expected=expected)
        if key in PLACES:
            places[key] = _place(law.key, key, value)
        elif key == "size":
            values = value.split("/")
            if len(values) > len(law.sizes):
                names = "/".join(s.name for s in law.sizes)
                raise InputError(f"effect {law.key}: size={value}", expected=f"at most {names}")
            pairs = zip(law.sizes, values, strict=False)
            sizes |= {s.name: _number(law.key, "size", v) * s.factor for s, v in pairs}
        else:
            size = next(s for s in law.sizes if s.name == key)
            sizes[key] = _number(law.key, key, value) * size.factor
    return Request(law.key, places, sizes)


def draw_term(request: Request, law: Law, rng: np.random.Generator, cell: Any) -> tuple[Term, bool]:
    """The term asked for, and whether its strength was left open."""
    asked = {**request.places, **({"sizes": request.sizes} if request.sizes else {})}
    term = law.draw(rng, cell, asked)
    if not request.sizes:
        return term, term.scalable
    return replace(term, parameters={k: request.sizes.get(k, 0.0) for k in term.parameters}), False


def _place(effect: str, key: str, value: str) -> Any:
    if key in WHOLE:
        if not value.isdigit() or int(value) < 1:
            raise InputError(f"effect {effect}: {key}={value}", expected="a whole number from 1")
        return int(value)
    return _number(effect, key, value) if key in ("from_s", "to_s") else value


def _number(effect: str, key: str, value: str) -> float:
    try:
        number = float(value)
    except ValueError:
        number = float("nan")
    if not np.isfinite(number):
        raise InputError(f"effect {effect}: {key}={value}", expected="a number")
    return number


def pick(
    rng: np.random.Generator, asked: Mapping[str, Any], key: str, choices: list[Any], effect: str
) -> Any:
    """What was asked for, if it is possible; else one of the choices.

    Raises:
        InputError: asked for something that is not there, or nothing to choose from.
    """
    if key in asked:
        if asked[key] not in choices:
            listed = ", ".join(str(c) for c in choices) or "nothing: this recording cannot carry it"
            raise InputError(f"effect {effect}: {key}={asked[key]}", expected=f"one of {listed}")
        return asked[key]
    if not choices:
        raise InputError(f"effect {effect} has no place in this recording", expected="another robot or kind")
    return choices[int(rng.integers(len(choices)))]
