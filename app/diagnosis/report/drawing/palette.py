"""One colour a family of the error budget, the same in every picture; neighbours stay apart for colour-blind eyes.

None is the orange of "before" or the blue of "after" (style.py).
"""

from __future__ import annotations

from app.diagnosis.result import UNNAMED

#: Grey is what has no name; noise is drawn lighter still.
COLOURS = {
    "conventions": "#4a3a8c",
    "mounting": "#4a3a8c",
    "zeros": "#12858a",
    "inertials": "#12858a",
    "geometry": "#74bfb0",
    "rotors": "#74bfb0",
    "elasticity": "#c2407a",
    "friction": "#c2407a",
    "gears": "#e3b92c",
    "timing": "#e3b92c",
    "play": "#8c5a2b",
    "couplings": "#9d8bd6",
    "load": "#5b8f2f",
    "instrument": "#a9b665",
    "drive": "#a9b665",
    "events": "#7a1f2b",
    UNNAMED: "#8b96a0",
}
#: Families whose colour is light: numbers on them are dark.
LIGHT = {"geometry", "rotors", "gears", "timing", "instrument", "drive"}
NOISE = "#d3dae0"
#: Families that are not in the list: later files may bring some.
OTHER = "#5b6873"


def colour(family: str) -> str:
    """The family's colour."""
    return COLOURS.get(family, OTHER)
