"""Mass, centre and inertia of a link differ from the description's."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.described import INERTIAL, Masses
from app.diagnosis.effects.dynamic._law import Law, Torques, Values, Where
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter
from app.diagnosis.thresholds.naming_logs import TRUST as BEYOND
from app.kinematics import RobotModel
from app.kinematics.dynamics import PER_LINK

TRUST = 0.2  # nominal size: a link's mass in descriptions drawn from CAD, relative


class LinkInertia(Law):
    key = "link_inertia"
    title = "the link's masses differ"
    family = "inertials"
    located_by = ("link",)
    equation = "tau = Y_link(q, qd, qdd) * (change of mass, first moment and inertia)"
    units: ClassVar = {
        "mass": "kg", "mx": "kg m", "my": "kg m", "mz": "kg m",
        **{f"i{a}": "kg m^2" for a in ("xx", "xy", "yy", "xz", "yz", "zz")},
    }  # fmt: skip
    linear = INERTIAL
    carried = True
    added = "payload"
    whole = True
    sure = True
    stated = True
    one_place = True
    spread = (1.0, 4.0, 25.0, 400.0, 1e4)

    def places(self, situation: State) -> Iterable[Place]:
        return [Place({"link": k + 1}) for k in range(situation.joints)]

    def columns(self, columns: State, place: Place) -> Torques:
        k = int(place.where["link"]) - 1
        part = columns.regressor[:, :, PER_LINK * k : PER_LINK * (k + 1)]
        return {j: part[:, j] for j in range(k + 1)}

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        k = int(place.where["link"]) - 1
        mass, size = situation.link_mass[k], situation.link_size[k]
        return TRUST * mass * np.array([1.0, *[size] * 3, *[size**2] * 6])

    def described(self, robot: RobotModel, where: Where, parameters: Values) -> tuple[Masses, ...]:
        return (Masses(int(where["link"]), np.array([parameters.get(name, 0.0) for name in INERTIAL])),)

    def beyond_trust(self, weights: np.ndarray) -> bool:
        return bool(np.sqrt(np.mean(weights[:4] ** 2)) > BEYOND)  # mass and first moment

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        values = {p.name: p.value for p in parameters}
        moment = float(np.linalg.norm([values["mx"], values["my"], values["mz"]]))
        return (
            f"Link {place.where['link']} is not as described: its mass by {values['mass']:+.3g} kg, "
            f"its first moment by {moment:.3g} kg m, as far as this motion shows them."
        )


EFFECT = LinkInertia()
