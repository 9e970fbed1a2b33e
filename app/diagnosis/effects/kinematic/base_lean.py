"""The base does not stand as upright as described: gravity loads the joints otherwise."""

from __future__ import annotations

from app.diagnosis.effects.kinematic._base import (
    KinematicEffect,
    Place,
    Quantity,
    joint_driver,
    joint_name,
    moving,
    nominal_compliance,
)

#: rad: floors and pedestals, a third of a degree.
_LEAN = 0.005


class BaseLean(KinematicEffect):
    """A joint gives way under what a lean of the base changes of its load: q_true = q - c * (lean x torque).

    A joint with an upright axis shows nothing else of what it gives way, and what it shows looks like a wave a turn:
    without it such a wave is said with more certainty than anybody can have. Small, and never a finding of its own;
    it belongs to the place where the arm stands.
    """

    key = "base_lean"
    title = "A joint gives way under the lean of the base"
    equation = "q_true = q - compliance * (torque under the gravity of a leaning base - torque)"
    family = "elasticity"
    group = "give"
    cap = 50.0
    whole = True
    always = True
    serving = True
    lasting = False

    def places(self, situation):
        if situation.leaning is None:
            return []
        return [Place({"joint": j, "driver": "gravity_torque"}) for j in moving(situation)]

    def quantities(self, situation, place):
        j = place.where["joint"]
        unit = "mm/N" if situation.chain.prismatic[j - 1] else "rad/Nm"
        width = nominal_compliance(situation, j) * _LEAN
        return tuple(Quantity(f"about_{axis}", unit, width) for axis in "xy")

    def apply(self, cell, situation, place, values):
        return cell.add_joint(place.where["joint"] - 1, -(_load(situation, place) @ values))

    def columns(self, columns, place):
        return joint_driver(columns, place.where["joint"], -_load(columns.situation, place))

    def sentence(self, place, parameters):
        return f"{joint_name(place).capitalize()} gives way under the lean of the base."


def _load(situation, place):
    """(m, 2) torque per radian of lean about the base's x and y."""
    return situation.leaning[:, place.where["joint"] - 1]


EFFECT = BaseLean()
