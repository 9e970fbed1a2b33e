"""Names, places and numbers as a person writes them. No markup here: text and page share it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from app.diagnosis.result import Diagnosis, Parameter
from app.units import deg, mm, um

#: SI unit of a parameter -> (unit a person reads, conversion), where they differ.
_READ_AS = {
    "rad": ("deg", deg),
    "m": ("mm", mm),
    "rad/Nm": ("µrad/Nm", um),
    "m/N": ("µm/N", um),
    "rad/s": ("deg/s", deg),
    "m/s": ("mm/s", mm),
}

DRIVERS = {
    "own_angle": "its own angle",
    "gravity_torque": "its gravity torque",
    "approach": "the direction it came from",
    "speed": "its speed",
    "acceleration": "its acceleration",
    "time": "time",
    "temperature": "temperature",
}

_NEARLY_ALL = 0.99
_COUNTS = {2: "two", 3: "three", 4: "four", 5: "five", 6: "six", 7: "seven", 8: "eight", 9: "nine"}

NOISE_SOURCES = {
    "repeats": "from repeated rows",
    "stated": "as stated in the file",
    "resolution": "from the digits written",
    "residual": "from the residual itself: nothing else tells it",
}


def effect_title(key: str) -> str:
    """`joint_compliance` -> "Joint compliance"."""
    return key.replace("_", " ").capitalize()


def place(where: Mapping[str, Any]) -> str:
    """`where` in words: "joint 2, driven by its gravity torque"."""
    parts: list[str] = []
    if where.get("body") is not None:
        parts.append(str(where["body"]))
    if where.get("joint") is not None:
        parts.append(f"joint {where['joint']}")
    if where.get("link") is not None:
        axis = f" ({where['axis']})" if where.get("axis") is not None else ""
        parts.append(f"link {where['link']}{axis}")
    if where.get("source_joint") is not None:
        parts.append(f"moved by joint {where['source_joint']}")
    if where.get("driver") is not None:
        driver = DRIVERS.get(str(where["driver"]), str(where["driver"]).replace("_", " "))
        # Without a joint to belong to, "its" has nothing to point at.
        parts.append("driven by " + (driver if where.get("joint") else driver.removeprefix("its ")))
    if where.get("from_row") is not None:
        parts.append(f"from data row {where['from_row']} on")
    if where.get("from_s") is not None and where.get("to_s") is not None:
        parts.append(f"from {where['from_s']:.2f} s to {where['to_s']:.2f} s")
    elif where.get("from_s") is not None:
        parts.append(f"from {where['from_s']:.2f} s on")
    known = {"body", "joint", "link", "axis", "source_joint", "driver", "from_row", "from_s", "to_s"}
    parts += [f"{key.replace('_', ' ')} {value}" for key, value in where.items() if key not in known]
    return ", ".join(parts) or "no single place"


def quantity(parameter: Parameter) -> str:
    """ "12.3 ± 0.4 µrad/Nm": the uncertainty gets two digits and the value as many places."""
    unit, convert = _READ_AS.get(
        parameter.unit, ("" if parameter.unit == "1" else parameter.unit, lambda x: x)
    )
    return f"{plus_minus(float(convert(parameter.value)), float(convert(parameter.std)))} {unit}".strip()


def plus_minus(value: float, std: float) -> str:
    """A value with its one-sigma uncertainty, both to the same place."""
    if not math.isfinite(std) or std <= 0:
        return f"{value:.4g}"
    places = 1 - math.floor(math.log10(std))
    if places > 9 or places < -6:
        return f"{value:.4g} ± {std:.2g}"
    if places <= 0:
        return f"{round(value, places):.0f} ± {round(std, places):.0f}"
    return f"{value:.{places}f} ± {std:.{places}f}"


def measure(value: float, unit: str) -> str:
    """A length of error, a torque or an angle, with three digits: "0.151 mm"."""
    if value is None or not math.isfinite(value):
        return "–"
    return f"{digits(value)} {unit}"


def digits(value: float, figures: int = 3) -> str:
    """Three figures without an exponent where a person would write none."""
    if value == 0 or not math.isfinite(value):
        return "0" if value == 0 else "–"
    exponent = math.floor(math.log10(abs(value)))
    if -4 <= exponent < 6:
        return f"{value:.{max(figures - 1 - exponent, 0)}f}"
    return f"{value:.{figures - 1}e}"


def probability(p: float) -> str:
    """ "p = 0.005", or "p < 0.0001" where the number itself says nothing more."""
    if p is None or not math.isfinite(p):
        return "p unknown"
    return "p < 0.0001" if p < 1e-4 else f"p = {p:.2g}"


def verdict_sentence(diagnosis: Diagnosis) -> str:
    """The verdict in one sentence."""
    count = len(diagnosis.findings)
    what = "one effect" if count == 1 else f"{_COUNTS.get(count, count)} effects"
    if diagnosis.verdict == "clean":
        return "Robot and description agree: nothing in this recording goes beyond its noise."
    if diagnosis.verdict == "named":
        return (
            f"The description leaves out {what}; with {'it' if count == 1 else 'them'} in the "
            "model nothing beyond noise is left."
        )
    if diagnosis.verdict == "partly":
        return (
            f"{what.capitalize()} found, but structure remains that no effect explains "
            f"(seen at: {place(diagnosis.leftover.where)})."
        )
    return (
        "There is structure beyond noise and no known effect explains it: no name is given. "
        f"Seen at: {place(diagnosis.leftover.where)}."
    )


def joint_values(q: Sequence[float], prismatic: Sequence[bool] = ()) -> str:
    """One pose: degrees for turning joints, millimetres for sliding ones."""
    slides = list(prismatic) or [False] * len(q)
    return "  ".join(f"{mm(v):.1f} mm" if s else f"{deg(v):.1f}°" for v, s in zip(q, slides, strict=True))


def fall(before: float, after: float) -> str:
    """How much smaller: "82% smaller", "unchanged"."""
    if not (math.isfinite(before) and math.isfinite(after)) or before <= 0:
        return ""
    share = 1 - after / before
    if abs(share) < 0.005:
        return "unchanged"
    if share > _NEARLY_ALL:
        return f"over {_NEARLY_ALL:.0%} smaller"
    return f"{abs(share):.0%} {'smaller' if share > 0 else 'larger'}"
