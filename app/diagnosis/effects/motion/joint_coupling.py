"""One joint loads another: through a coupled wrist gear, a belt, or the reaction of a motor."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import Law, Place, Values, Where
from app.diagnosis.effects.motion._state import State


class JointCoupling(Law):
    key = "joint_coupling"
    title = "another joint loads it"
    equation = "tau_joint = coupling * x_source, x = qd, qdd, q or sign(qd)"
    units: ClassVar = {"coupling": ""}
    linear = ("coupling",)

    def places(self, state: State) -> list[Place]:
        return [
            Place({"joint": j + 1, "source_joint": s + 1, "driver": driver})
            for j in range(state.joints)
            for s in range(state.joints)
            if s != j and state.moves(s)
            for driver in ("speed", "acceleration", "own_angle", "gravity_torque")
        ]

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        source = int(where["source_joint"]) - 1
        values = {
            "speed": state.qd,
            "acceleration": state.qdd,
            "own_angle": state.q,
            "gravity_torque": state.torque,
        }[where["driver"]]
        return values[:, source, None]

    def explain(self, where: Where, values: Values) -> str:
        return (
            f"Joint {where['joint']} is loaded by joint {where['source_joint']} "
            f"({where['driver'].replace('_', ' ')} times {values['coupling']:.4g})."
        )


EFFECT = JointCoupling()
