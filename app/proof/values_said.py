"""Values said beside values that are true."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from app.proof.units_said import si_factor

#: What a value is judged by, where it is not all parameters: those that say how strong it is.
STRENGTHS = {
    "payload": ("mass",),
    "payload_change": ("mass",),
    "joint_spring": ("stiffness",),
    "torque_ripple": ("sine", "cosine"),
    "stribeck_friction": ("stribeck",),
    "warmup_friction": ("cold",),
}
#: Where nothing wrong is not nothing: gravity as the description has it [m/s^2].
NOTHING = {"gx": 0.0, "gy": 0.0, "gz": -9.81}


def size(truth: Mapping[str, Any]) -> float:
    """Length of the strengths."""
    values = truth["parameters"]
    return sum((values[k] - NOTHING.get(k, 0.0)) ** 2 for k in strengths(truth)) ** 0.5


def strengths(truth: Mapping[str, Any]) -> tuple[str, ...]:
    """Names of the parameters that say how strong it is."""
    return STRENGTHS.get(truth["effect"], tuple(truth["parameters"]))


def differences(finding: Mapping[str, Any], truth: Mapping[str, Any]) -> list[tuple[float, float | None]]:
    """Said minus true of each strength, and its stated standard deviation, in SI."""
    given = {p["name"]: p for p in finding.get("parameters", ())}
    out = []
    for name in strengths(truth):
        true = truth["parameters"][name]
        stated = given.get(name)
        if stated is None or stated.get("value") is None:
            out.append((-true, None))
            continue
        factor, std = si_factor(stated.get("unit") or ""), stated.get("std")
        out.append((stated["value"] * factor - true, std * factor if std else None))
    return out
