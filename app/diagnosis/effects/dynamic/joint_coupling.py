"""One joint loads another: through shared motors, a hose package, a differential wrist."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import SHARE, SLIP, WIDTH, Law, Torques, Values, Where, choice, turn
from app.diagnosis.effects.effect import Place, Quantity
from app.diagnosis.models.dynamic.state import State, turned
from app.diagnosis.result import Parameter

DRIVERS = ("speed", "acceleration", "own_angle")
#: Two joints driven through one differential: which way the speeds add, as saved.
SENSE = "fixed_sense"


class JointCoupling(Law):
    """Either one joint's torque follows another's motion, or two share motors: friction of their sum or difference."""

    key = "joint_coupling"
    title = "another joint loads it"
    family = "couplings"
    located_by = ("joint",)
    equation = "tau_joint = coupling * x_source, x = qd, qdd, q or sign(qd)"
    units: ClassVar = {"coupling": "", "dry": "Nm", "viscous": "Nm s/rad", "inertia": "kg m^2"}
    linear = ("coupling",)
    blunt = True
    shared = ("dry", "viscous", "inertia")

    def places(self, situation: State) -> Iterable[Place]:
        n = situation.joints
        single = [
            Place(
                {"joint": j + 1, "source_joint": s + 1, "driver": driver}, cost=choice(len(DRIVERS) * (n - 1))
            )
            for j in range(n)
            for s in range(n)
            if s != j and situation.moves(s)
            for driver in DRIVERS
        ]
        pairs = [
            Place(
                {"joint": a + 1, "source_joint": b + 1, "driver": "speed"}, {SENSE: float(sense)},
                cost=choice(n if b == a + 1 else n * n),
            )
            for a, b in combinations([j for j in range(n) if situation.moves(j)], 2)
            for sense in (1, -1)
        ]  # fmt: skip
        return [*single, *pairs]

    def quantities(self, situation: State, place: Place) -> tuple[Quantity, ...]:
        names = self.shared if SENSE in place.fixed else self.linear
        return tuple(Quantity(name, self.units[name], 1.0) for name in names)

    def columns(self, columns: State, place: Place) -> Torques:
        joint, source = (int(place.where[k]) - 1 for k in ("joint", "source_joint"))
        if SENSE not in place.fixed:
            of = {"speed": columns.qd, "acceleration": columns.qdd, "own_angle": columns.q,
                  "gravity_torque": columns.torque}[place.where["driver"]]  # fmt: skip
            return {joint: of[:, source, None]}
        sense = place.fixed[SENSE]
        shape = place.fixed if WIDTH in place.fixed else turn(columns, joint, source)
        speed, way = (x[..., joint] + sense * x[..., source] for x in (columns.fine, columns.q))
        dry = turned(speed, way, shape[WIDTH], shape.get(SLIP, 0.0))
        # The sum's own viscous friction and inertia, each joint's share of it beside what its own laws hold.
        qd, qdd = columns.qd, columns.qdd
        return {
            joint: np.stack([dry, sense * qd[:, source], sense * qdd[:, source]], axis=1),
            source: np.stack([sense * dry, sense * qd[:, joint], sense * qdd[:, joint]], axis=1),
        }

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        found = self.columns(situation, place) if found is None else found
        each = [
            SHARE * situation.size[j] / np.maximum(np.sqrt(np.mean(c**2, axis=0)), 1e-12)
            for j, c in found.items()
        ]
        return np.minimum(np.min(each, axis=0), 1e12)

    def saved(self, place: Place, values: np.ndarray) -> dict[str, float]:
        names = self.shared if SENSE in place.fixed else self.linear
        return {**dict(zip(names, map(float, values), strict=True)), **place.fixed}

    def torque(self, state: State, where: Where, parameters: Values) -> Torques:
        names = self.shared if SENSE in parameters else self.linear
        fixed = {k: v for k, v in parameters.items() if k not in names}
        values = np.array([parameters[k] for k in names])
        return {j: c @ values for j, c in self.columns(state, Place(where, fixed)).items()}

    def reported(self, place: Place, values: np.ndarray, covariance: np.ndarray) -> tuple[Parameter, ...]:
        std = np.sqrt(np.maximum(np.diag(covariance), 0.0))
        names = self.shared if SENSE in place.fixed else self.linear
        return tuple(
            Parameter(name, float(v), float(s), self.units[name])
            for name, v, s in zip(names, values, std, strict=True)
        )

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        joint, source = place.where["joint"], place.where["source_joint"]
        if SENSE in place.fixed:
            way = "sum" if place.fixed[SENSE] > 0 else "difference"
            dry = parameters[0].value
            return f"Joints {joint} and {source} share motors: friction of the {way} of their speeds, {dry:.4g} Nm."
        driver = str(place.where["driver"]).replace("_", " ")
        return f"Joint {joint} is loaded by joint {source} ({driver} times {parameters[0].value:.4g})."


EFFECT = JointCoupling()
