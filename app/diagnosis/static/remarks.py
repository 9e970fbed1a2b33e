"""What a person should know beside the findings."""

from __future__ import annotations

from app.diagnosis.result import Noise
from app.diagnosis.static.as_built import spread_of
from app.diagnosis.static.noise import known_noise, position_rms, rounding_noise
from app.diagnosis.static.outcome import Outcome
from app.units import mm


def remarks(outcome: Outcome, noise: Noise, hopeless: bool, excess: bool) -> tuple[str, ...]:
    """Notes on masses, noise, geometry, outliers and misfits."""
    recording, plan = outcome.written.recording, outcome.plan
    found = plan.found.fitted
    out = []
    situation = recording.situation
    driven = [t for t in found.terms if t.where.get("driver") == "gravity_torque"]
    if situation.torque_source == "assumed" and driven:
        out.append("the description states no masses: 20 kg per metre of link were assumed for gravity")
    if situation.torque_source == "measured" and driven:
        out.append("the measured joint torques were used")
    if noise.source == "residual":
        out.append("the noise is not known from repeats nor stated: it is taken from what the fit leaves")
    if noise.source == "resolution":
        out.append(f"the digits written make {noise.value:.2g} mm of noise by themselves")
    if plan.as_built:
        out.append(
            f"the arm's geometry differs in many places (about {mm(spread_of(found)):.2g} mm and as many mrad each): "
            "all of it was fitted alongside and is part of the saved model"
        )
    if outcome.outliers.any():
        out.append(f"{int(outcome.outliers.sum())} rows do not belong to the others and were set aside")
    if hopeless:
        out.append(
            f"base and tool leave {mm(position_rms(outcome.before)):.3g} mm: the measurements do not belong to these "
            "poses, or the recording is of another robot"
        )
    elif excess:
        known = known_noise(recording).sigma
        rounded = rounding_noise(recording, found)
        text = f"{mm(position_rms(found)):.3g} mm remain where the noise is {noise.value:.2g} mm"
        if known is not None and rounded > 0.7 * (position_rms(found) ** 2 - known**2) ** 0.5:
            text += f"; the rounded angles alone make {mm(rounded):.2g} mm"
        out.append(text)
    return tuple(out)
