"""A joint that twists: behind the motor the link swings on a spring with a damper, and the motor feels it.

The recorded angle is the motor's, as that of most arms is. Where the link would take the torque u if it were fixed to
the motor, the spring carries

    stiffness x + damping x',   inertia x'' + damping x' + (stiffness + weight) x = u,

x the twist and weight what gravity adds to u per angle. Every joint feels that the link stands back by x and
accelerates less by x''. Other joints count as rigid, and speeds as they are without the twist.

Source: Spong (1987), Modeling and control of elastic joint robots, J. Dyn. Sys. Meas. Control 109(4).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import Law, Torques, Values, Where, choice
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.every_sample import EverySample
from app.diagnosis.models.dynamic.resonance import resonance_of
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.models.dynamic.two_mass import Behind, twist
from app.diagnosis.quantity import quantity
from app.diagnosis.result import Parameter
from app.diagnosis.thresholds.elastic import SHARE
from app.estimation import plus_minus

TRIED = 50  # stiffnesses times dampings that a log can tell apart: what the choice among them costs


class ElasticJoint(Law):
    key = "elastic_joint"
    title = "a joint that twists under its load"
    family = "drive"
    driver = "acceleration"
    equation = "tau = stiffness * x + damping * x', inertia * x'' + damping * x' + stiffness * x = tau_rigid"
    units: ClassVar = {
        "stiffness": "Nm/rad",
        "damping": "Nm s/rad",
        "inertia": "kg m^2",
        "share": "1",
        "resonance": "Hz",
        "damping_ratio": "1",
    }
    linear = ("share",)
    bent: ClassVar = {"stiffness": 0.03, "damping": 0.3, "resonance": 0.015, "damping_ratio": 0.3}
    rough: ClassVar = {
        "stiffness": 0.002,
        "damping": 0.02,
        "resonance": 0.001,
        "damping_ratio": 0.02,
    }  # smoothed motion; what a twist changes in speeds
    follows_load = True
    both_sides = "gravity_torque"
    located_by = ("joint",)
    no_words = (
        "a description has rigid joints: as written, motor and link move as one; a body with the rotor's inertia, "
        "put between them by hand, and a joint with this stiffness and damping behind it would do"
    )

    def places(self, situation: State) -> Iterable[Place]:
        found = []
        for j in range(situation.joints):
            heard = resonance_of(situation, j)
            if heard is not None:
                fixed = {"stiffness": heard.stiffness, "damping": heard.damping, "inertia": heard.inertia}
                if not heard.inertia:  # without masses, what they ring with is all that a log tells
                    turn = float(np.sqrt(heard.stiffness))
                    fixed = {"resonance": turn / (2.0 * np.pi), "damping_ratio": 0.5 * heard.damping / turn}
                where = {"joint": j + 1, "driver": self.driver}
                found.append(Place(where, fixed, cost=choice(TRIED)))
        return found

    def torque(self, state: State, where: Where, parameters: Values) -> Torques:
        if (
            where.get("driver") == self.both_sides
        ):  # the log has the link's angle: its torque is the rigid one
            return {}
        size = parameters["inertia" if "resonance" in parameters else "share"]
        return {j: size * c[:, 0] for j, c in self.columns(state, Place(where, dict(parameters))).items()}

    def columns(self, columns: State, place: Place) -> Torques:
        joint, every = int(place.where["joint"]) - 1, columns.every
        if every is None:
            return {joint: np.zeros((len(columns.t), 1))}
        if "resonance" in place.fixed:
            return {joint: self._of_unknown_link(columns, every, joint, place.fixed)}
        inertia, weight = every.inertia(joint), every.weight(joint)
        rigid = every.rigid[:, joint]
        added = columns.torque[:, joint] - every.pooled(rigid)  # loads and masses that were found
        behind = Behind(
            rigid + np.interp(every.t, columns.t, added),
            np.interp(every.t, columns.t, inertia[:, joint]),
            np.interp(every.t, columns.t, weight[:, joint]),
        )
        turned, push = (
            every.pooled(v)
            for v in twist(every.t, behind, place.fixed["stiffness"], place.fixed["damping"], every.runs)
        )
        return {j: -(inertia[:, j] * push + weight[:, j] * turned)[:, None] for j in range(columns.joints)}

    def _of_unknown_link(self, columns: State, every: EverySample, joint: int, fixed: Values) -> np.ndarray:
        """(M, 1) torque per kg m^2 that swings behind the joint, driven by its acceleration alone."""
        push = np.interp(every.t, columns.t, columns.qdd[:, joint])
        turn = 2.0 * np.pi * fixed["resonance"]
        behind = Behind(push, np.ones(len(push)), np.zeros(len(push)))
        _, swings = twist(every.t, behind, turn**2, 2.0 * fixed["damping_ratio"] * turn, every.runs)
        return -every.pooled(swings)[:, None]

    def saved(self, place: Place, values: np.ndarray) -> dict[str, float]:
        return {"inertia" if "resonance" in place.fixed else "share": float(values[0]), **place.fixed}

    def reported(self, place: Place, values: np.ndarray, covariance: np.ndarray) -> tuple[Parameter, ...]:
        found = super().reported(place, values, covariance)
        return (replace(found[0], std=float(np.sqrt(max(covariance[0, 0], 0.0)))), *found[1:])

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        return super().widths(situation, place, found) if "resonance" in place.fixed else np.ones(1)

    def lawful(self, parameters: Values) -> bool:
        if "resonance" in parameters:
            return parameters["inertia"] > 0.0
        return SHARE[0] < parameters["share"] < SHARE[1]

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        values = {p.name: p for p in parameters}
        if "resonance" in values:
            ratio = values["damping_ratio"].value
            return (
                f"Joint {place.where['joint']} twists: what swings behind it rings at {quantity(values['resonance'])}, "
                f"at {ratio:.2g} of the damping that would let nothing ring. The description has no masses: stiffness "
                "and damping themselves ask for the link's inertia."
            )
        stiffness, damping, inertia = values["stiffness"], values["damping"], values["inertia"].value
        turn = float(np.sqrt(stiffness.value / inertia))
        frequency = turn / (2.0 * np.pi)
        spread = 0.5 * frequency * stiffness.std / stiffness.value
        ratio = damping.value / (2.0 * inertia * turn)
        return (
            f"Joint {place.where['joint']} twists: stiffness {quantity(stiffness)}, damping {quantity(damping)}. "
            f"With the {inertia:.3g} kg m^2 that the description gives it in the mean of this log that rings at "
            f"{plus_minus(frequency, spread, 'Hz')}, at {ratio:.2g} of the damping "
            "that would let nothing ring; the stiffness is as true as that inertia."
        )


EFFECT = ElasticJoint()
