"""A robot's address: a name or a path, and what was chosen in it.

    ur10e        arm.urdf        arm.urdf#flange=tcp        torso.urdf#chain=torso..left_tool0
    ur10e#calibration=calibration.conf

One text that a command line, a file's header and a session's journal can all hold.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote, unquote

from app.errors import InputError

_KEYS = ("flange", "chain", "calibration")
_LONGEST = 4096


@dataclass(frozen=True)
class Address:
    """Where a robot is, and which part of it is meant.

    Args:
        place: a shipped robot's name or the path of a description; "" where only a part was chosen.
        flange: the link tools are bolted to; None takes the default (see flange.py).
        chain: (base, tip) links of the arm within a tree; None takes the whole.
        calibration: the maker's calibration file of this one arm.
    """

    place: str
    flange: str | None = None
    chain: tuple[str, str] | None = None
    calibration: str | None = None

    def __str__(self) -> str:
        chosen = {
            "flange": self.flange,
            "chain": "..".join(self.chain) if self.chain else None,
            "calibration": self.calibration,
        }
        parts = "&".join(f"{k}={quote(v, safe=' ./')}" for k, v in chosen.items() if v is not None)
        return f"{self.place}#{parts}" if parts else self.place

    def but(
        self, flange: str | None = None, chain: str | None = None, calibration: str | None = None
    ) -> Address:
        """The same with what else was chosen; None leaves what is there."""
        return Address(
            self.place,
            self.flange if flange is None else _link(flange, "flange"),
            self.chain if chain is None else _ends(chain),
            self.calibration if calibration is None else calibration,
        )


def parse_address(text: str) -> Address:
    """Takes an address apart.

    Raises:
        InputError: a choice that is none of `flange=LINK`, `chain=BASE..TIP`.
    """
    if len(text) > _LONGEST:
        raise InputError(f"an address of {len(text)} characters", column="robot", expected="a name or a path")
    place, mark, rest = text.partition("#")
    try:
        whole = bool(mark) and Path(text).is_file()
    except (OSError, ValueError):
        whole = False
    if not mark or whole:
        return Address(text)
    address = Address(place)
    for part in filter(None, rest.split("&")):
        key, _, value = part.partition("=")
        if key not in _KEYS or not value:
            raise InputError(
                f"robot {text[:80]!r} says {part[:40]!r}",
                expected="FILE.urdf#flange=LINK or FILE.urdf#chain=BASE..TIP",
            )
        address = address.but(**{key: unquote(value)})
    return address


def address_of(
    robot: str | None,
    flange: str | None = None,
    chain: str | None = None,
    calibration: str | None = None,
) -> str | None:
    """What a command line says of its robot as one text; None where it says nothing.

    Raises:
        InputError: a chain without its two ends.
    """
    if robot is None and flange is None and chain is None and calibration is None:
        return None
    return str(parse_address(robot or "").but(flange, chain, calibration))


def _link(name: str, column: str) -> str:
    if not name.strip():
        raise InputError("an empty name", column=column, expected="the name of a link")
    return name.strip()


def _ends(text: str) -> tuple[str, str]:
    base, mark, tip = text.partition("..")
    if not mark or not base.strip() or not tip.strip():
        raise InputError(f"chain {text[:60]!r}", column="chain", expected="BASE..TIP, two links")
    return base.strip(), tip.strip()
