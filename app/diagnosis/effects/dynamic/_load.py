"""A body fixed to the flange or to another link: what its mass and centre do to the joints."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import Law, Torques, Values, Where, everywhere
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter
from app.kinematics.dynamics import PER_LINK, point_mass

SMALLEST = 1e-3  # kg; below it a centre means nothing
MASS, MOMENT, INERTIA = 0.05, 0.01, 0.001  # nominal sizes: shares of the arm's mass, times 1 m and 1 m^2


class Load(Law):
    """A body on the flange, or in the frame of link k where `where` says so.

    Its inertia about its own centre is fitted and saved, but no value of a finding.
    """

    units: ClassVar = {"mass": "kg", "com_x": "m", "com_y": "m", "com_z": "m"}
    linear = ("mass", "mx", "my", "mz", "ixx", "ixy", "iyy", "ixz", "iyz", "izz")
    carried = True

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        arm = float(situation.link_mass.sum())
        return arm * np.array([MASS, *[MOMENT] * 3, *[INERTIA] * 6])

    def saved(self, place: Place, values: np.ndarray) -> dict[str, float]:
        mass = float(values[0])
        safe = mass if abs(mass) > SMALLEST else SMALLEST
        com = values[1:4] / safe
        point = point_mass(mass, com)[4:]
        names = ("xx", "xy", "yy", "xz", "yz", "zz")
        own = {f"fixed_i{a}": float(v) for a, v in zip(names, values[4:] - point, strict=True)}
        return {"mass": mass, "com_x": float(com[0]), "com_y": float(com[1]), "com_z": float(com[2]), **own}

    def body(self, parameters: Values) -> np.ndarray:
        """(10,) inertial parameters in the flange's or the link's frame."""
        out = point_mass(parameters["mass"], np.array([parameters[f"com_{c}"] for c in "xyz"]))
        out[4:] += [parameters.get(f"fixed_i{a}", 0.0) for a in ("xx", "xy", "yy", "xz", "yz", "zz")]
        return out

    def columns(self, columns: State, place: Place) -> Torques:
        active = self.active(columns, place.where)
        return {j: c * active[:, None] for j, c in _of_body(columns, place.where).items()}

    def torque(self, state: State, where: Where, parameters: Values) -> Torques:
        active, body = self.active(state, where), self.body(parameters)
        return {j: (c @ body) * active for j, c in _of_body(state, where).items()}

    def active(self, state: State, where: Where) -> np.ndarray:
        """(M,) 1 while the body is there."""
        return np.ones(len(state.t))

    def reported(self, place: Place, values: np.ndarray, covariance: np.ndarray) -> tuple[Parameter, ...]:
        found = self.saved(place, values)
        mass = found["mass"]
        safe = mass if abs(mass) > SMALLEST else SMALLEST
        out = [Parameter("mass", mass, float(np.sqrt(max(covariance[0, 0], 0.0))), "kg")]
        for k, c in enumerate("xyz", 1):
            slope = np.zeros(len(values))
            slope[0], slope[k] = -values[k] / safe**2, 1.0 / safe
            std = float(np.sqrt(max(slope @ covariance @ slope, 0.0)))
            out.append(Parameter(f"com_{c}", found[f"com_{c}"], std, "m"))
        return tuple(out)


def _of_body(state: State, where: Where) -> Torques:
    """Joint -> (M, 10) torque per inertial parameter of a body fixed to the flange or to a link."""
    if "link" not in where:
        return everywhere(state.payload_columns)
    k = int(where["link"])
    part = state.regressor[:, :, PER_LINK * (k - 1) : PER_LINK * k]
    return {j: part[:, j] for j in range(k)}
