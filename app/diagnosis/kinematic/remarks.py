"""What a person should know beside the findings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.diagnosis.effects.effect import EDGE
from app.diagnosis.kinematic.description import Description
from app.diagnosis.observations.noise import residual_rms, rounding_noise
from app.diagnosis.result import Noise
from app.diagnosis.wording import note
from app.units import mm

if TYPE_CHECKING:
    from app.diagnosis.kinematic.judging import Judgement
    from app.diagnosis.kinematic.left import Left


def remarks(
    found: Description, judgement: Judgement, noise: Noise, left: Left, robot: str
) -> tuple[str, ...]:
    """Notes on masses, noise, outliers and what remains."""
    situation = found.library.situation
    out = []
    driven = any(
        found.library.fixed[n].place.where.get("driver") == "gravity_torque" for n in found.numbers()
    )
    if situation.torque_source == "assumed" and driven:
        out.append(note("masses_assumed"))
    if situation.torque_source == "measured" and driven:
        out.append(note("torques_used"))
    if noise.source == "residual":
        out.append(note("noise_unknown"))
    if noise.source == "resolution":
        out.append(note("digits", noise=noise.value))
    if found.dense:
        out.append(note("everywhere"))
    aside = int((~judgement.kept).sum())
    if aside:
        out.append(note("outliers", count=aside))
    if left.another is not None:
        candidate, value = left.another
        unit = candidate.effect.quantities(situation, candidate.place)[0].unit
        said = {"link": candidate.place.where.get("link"), "off": abs(value) * EDGE[unit], "robot": robot}
        longer = unit == "mm"
        out.append(note("another_arm_length", **said) if longer else note("another_arm_twist", **said))
    elif left.hopeless:
        out.append(note("hopeless", left=mm(residual_rms(judgement.after, judgement.kept))))
    elif left.excess:
        rounded = rounding_noise(judgement.after.recording, judgement.after)
        rest = residual_rms(judgement.after, judgement.kept)
        said = {"left": mm(rest), "noise": noise.value}
        if mm(rounded) > 0.7 * max(mm(rest) ** 2 - noise.value**2, 0.0) ** 0.5:
            out.append(note("excess_rounded", rounded=mm(rounded), **said))
        else:
            out.append(note("excess", **said))
    return tuple(out)
