"""A mass at the flange that nobody declared; the joints give way under it."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.described import body
from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity
from app.diagnosis.quantity import quantity
from app.diagnosis.result import Parameter

_NEGLIGIBLE = 1e-3  # kg: below this the centre of mass means nothing
#: kg, and kg m: tools and workpieces.
_WIDTH_KG, _WIDTH_KG_M = 0.5, 0.05


class Payload(KinematicEffect):
    """Needs declared compliances, through which its weight is felt."""

    key = "payload"
    title = "An undeclared payload"
    equation = "q_true = q - compliance_declared * torque(mass, com)"
    family = "load"
    cap = 100.0

    def places(self, situation):
        if situation.declared_compliance is None or not np.any(situation.declared_compliance > 0):
            return []
        return [Place({"body": "tool"}, {"centred": centred}) for centred in (1.0, 0.0)]

    def quantities(self, situation, place):
        mass = (Quantity("mass", "kg", _WIDTH_KG, lower=0.0),)
        moments = tuple(Quantity(f"moment_{c}", "kg m", _WIDTH_KG_M) for c in "xyz")
        return mass if place.fixed["centred"] else mass + moments

    def apply(self, cell, situation, place, values):
        assert situation.declared_compliance is not None
        sag = situation.moment[:, :, : len(values)] @ values  # (m, n) Nm
        for j in range(situation.joint_count):
            if situation.declared_compliance[j]:
                cell = cell.add_joint(j, -situation.declared_compliance[j] * sag[:, j])
        return cell

    def columns(self, columns, place):
        count = 1 if place.fixed["centred"] else 4
        situation = columns.situation
        assert situation.declared_compliance is not None
        driven = -situation.declared_compliance[None, :, None] * situation.moment[:, :, :count]
        return np.einsum("mkn,mnd->mkd", columns.joint, driven)

    def report(self, situation, place, values, covariance):
        mass = float(values[0])
        std = float(np.sqrt(max(covariance[0, 0], 0.0)))
        out = [Parameter("mass", mass, std, "kg")]
        for i, c in enumerate("xyz", start=1):
            if place.fixed["centred"] or abs(mass) < _NEGLIGIBLE:
                out.append(Parameter(f"com_{c}", 0.0, 0.0, "m"))
                continue
            slope = np.zeros(len(values))
            slope[0], slope[i] = -values[i] / mass**2, 1.0 / mass
            out.append(
                Parameter(
                    f"com_{c}",
                    float(values[i]) / mass,
                    float(np.sqrt(max(slope @ covariance @ slope, 0.0))),
                    "m",
                )
            )
        return tuple(out)

    def described(self, robot, where, parameters):
        mass = parameters.get("mass", 0.0)
        if abs(mass) > _NEGLIGIBLE:
            centre = {f"com_{c}": parameters.get(f"moment_{c}", 0.0) / mass for c in "xyz"}
            parameters = {**centre, **parameters}
        return body(where, parameters)

    def impossible(self, parameters):
        # in a log a load below nothing is a hand that the description has and the arm has not
        return ("mass", "0 kg or more") if parameters.get("mass", 0.0) < 0.0 else None

    def sentence(self, place, parameters):
        return f"The flange carries {quantity(parameters[0])} that nobody declared."


EFFECT = Payload()
