"""What a person should know beside the findings."""

from __future__ import annotations

from app.diagnosis.result import Noise
from app.diagnosis.static.as_built import spread_of
from app.diagnosis.static.noise import known_noise, position_rms, rounding_noise
from app.diagnosis.static.outcome import Outcome
from app.diagnosis.wording import note
from app.units import mm


def remarks(outcome: Outcome, noise: Noise, hopeless: bool, excess: bool, crowd: int = 0) -> tuple[str, ...]:
    """Notes on masses, noise, geometry, outliers and misfits.

    Args:
        crowd: number of findings where they are too many to be believed, else 0.
    """
    recording, plan = outcome.written.recording, outcome.plan
    found = plan.found.fitted
    out = []
    situation = recording.situation
    driven = [t for t in found.terms if t.where.get("driver") == "gravity_torque"]
    if situation.torque_source == "assumed" and driven:
        out.append(note("masses_assumed"))
    if situation.torque_source == "measured" and driven:
        out.append(note("torques_used"))
    if noise.source == "residual":
        out.append(note("noise_unknown"))
    if noise.source == "resolution":
        out.append(note("digits", noise=noise.value))
    if plan.as_built:
        out.append(note("as_built", spread=mm(spread_of(found))))
    if outcome.outliers.any():
        out.append(note("outliers", count=int(outcome.outliers.sum())))
    if crowd:
        out.append(note("crowd", count=crowd))
    if hopeless:
        out.append(note("hopeless", left=mm(position_rms(outcome.before))))
    elif excess:
        known = known_noise(recording).sigma
        rounded = rounding_noise(recording, found)
        left = {"left": mm(position_rms(found)), "noise": noise.value}
        if known is not None and rounded > 0.7 * (position_rms(found) ** 2 - known**2) ** 0.5:
            out.append(note("excess_rounded", rounded=mm(rounded), **left))
        else:
            out.append(note("excess", **left))
    return tuple(out)
