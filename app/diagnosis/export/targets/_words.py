"""Numbers, names and remarks as the targets write them."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from app.diagnosis.export.arm import Left, SimArm, SimJoint


def said(values: np.ndarray | Iterable[float]) -> str:
    """Numbers in full, so that reading gives the same ones."""
    return " ".join(repr(float(v) + 0.0) for v in np.asarray(values, float).ravel())


def named(name: str) -> str:
    """A name that XML, USD and every simulator takes."""
    clean = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in name)
    return clean if clean and not clean[0].isdigit() else f"_{clean}"


def joint_names(arm: SimArm) -> list[str]:
    """Names of the joints, each once."""
    out: list[str] = []
    for joint in arm.joints:
        name = named(joint.name)
        while name in out:
            name += "_"
        out.append(name)
    return out


def remark(arm: SimArm, form: str, left: Iterable[Left], mark: str = "") -> str:
    """What stands at the top of a file: what it is, what it does not carry. No line holds `--`, which XML refuses."""
    lines = [f"{arm.name}: made by teachframe export-model for {form}"]
    if arm.source:
        lines.append(f"learnt from {arm.source}")
    lines += [f"not carried: {entry}" for entry in left]
    clean = ("".join(c if c.isprintable() else " " for c in line).replace("--", "- -") for line in lines)
    return "\n".join(mark + line for line in clean)


def of_joint(joint: SimJoint, number: int, field: str, why: str) -> Left | None:
    """A joint's quantity that a target has no place for; None where it is zero."""
    value = float(getattr(joint, field))
    if value == (1.0 if field == "gain" else 0.0):
        return None
    words = {
        "damping": "viscous friction",
        "damping2": "quadratic friction",
        "friction": "dry friction",
        "armature": "rotor inertia",
        "stiffness": "stiffness of a spring",
        "offset": "constant torque",
        "gain": "torque factor",
    }
    linear = joint.prismatic
    units = {
        "damping": "N s/m" if linear else "Nm s/rad",
        "damping2": "N s^2/m^2" if linear else "Nm s^2/rad^2",
        "friction": "N" if linear else "Nm",
        "armature": "kg" if linear else "kg m^2",
        "stiffness": "N/m" if linear else "Nm/rad",
        "offset": "N" if linear else "Nm",
        "gain": "recorded over true",
    }
    return Left(f"{words[field]} (joint {number})", f"{value:.6g} {units[field]}", why)


def lateness(arm: SimArm, why: str) -> Left:
    """What a target has no place for of how late the torques are."""
    return Left("delay", f"{arm.delay:.4g} s", why)


def lost(arm: SimArm, fields: Iterable[str], why: str) -> list[Left]:
    """All joints' quantities that a target has no place for."""
    found = (of_joint(j, k, f, why) for f in fields for k, j in enumerate(arm.joints, 1))
    return [entry for entry in found if entry is not None]
