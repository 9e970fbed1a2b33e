"""What the pairs of jog buttons are called: joints, or the maker's names of shifts and turns."""

from __future__ import annotations

from app.calibration.vocabularies import vocabulary

_SHIFTS = ((0, "X"), (1, "Y"), (2, "Z"))
_TURNS = ((3, "RX"), (4, "RY"), (5, "RZ"))


def pairs(frame: str, joints: int, maker: str) -> tuple[tuple[int, str], ...]:
    """(axis, name) of each pair, in the order of the buttons."""
    if frame == "joint":
        return tuple((k, f"J{k + 1}") for k in range(joints))
    return _SHIFTS + turns(maker)


def turns(maker: str) -> tuple[tuple[int, str], ...]:
    """The turns as this maker names them: FANUC's W, P, R about X, Y, Z; KUKA's A, B, C about Z, Y, X.

    Where its pendant shows no three angles about single axes, or no maker is chosen, RX, RY, RZ.
    """
    if not maker:
        return _TURNS
    words = vocabulary(maker)
    if sorted(words.convention) != ["X", "Y", "Z"]:
        return _TURNS
    return tuple(
        (3 + "XYZ".index(letter), name)
        for letter, name in zip(words.convention, words.angle_names, strict=True)
    )
