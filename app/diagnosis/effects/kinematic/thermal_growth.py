"""A link, or every link, grows as the arm warms up."""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity, joints
from app.diagnosis.models.kinematic.pace import forms, per_unit, shaped
from app.diagnosis.quantity import quantity
from app.diagnosis.thresholds.evidence import LAW

#: relative, over the whole recording: aluminium and steel warmed by 10 to 20 K.
_WIDTH = 2e-4
#: m: a shorter link does not grow as far as anybody can tell.
_SHORTEST = 0.02


class ThermalGrowth(KinematicEffect):
    """length = length_nominal (1 + rate s), s the time (or temperature) since the first row.

    With a time constant the growth settles: s = tau (1 - exp(-t / tau)), and the rate is the one at the start.
    Source: Heisel, Richter, Wurst, "Thermal behaviour of industrial robots" (1997).
    """

    key = "thermal_growth"
    title = "Links grow as the arm warms up"
    equation = "length = length_nominal * (1 + rate * s), s = t - t0 or tau (1 - exp(-(t - t0) / tau))"
    family = "events"
    level = Level.MECHANISM
    penalty = LAW + 1.0
    cap = 20.0
    lasting = False

    def places(self, situation):
        for driver, fixed, cost in forms(situation):
            yield Place({"driver": driver}, fixed, cost=cost, member=False)
            for k in joints(situation):
                if np.linalg.norm(situation.links.lengths[k - 1]) > _SHORTEST:
                    yield Place({"link": k, "driver": driver}, fixed, cost=cost, member=False)

    def quantities(self, situation, place):
        reach = max(float(np.ptp(shaped(situation, place))), 1e-12)
        return (Quantity("rate", "1" + per_unit(situation, place), _WIDTH / reach),)

    def apply(self, cell, situation, place, values):
        growth = values[0] * shaped(situation, place)
        for k in _links(situation, place):
            cell = cell.add_link(k, growth[:, None] * situation.links.lengths[k], np.zeros(3))
        return cell

    def columns(self, columns, place):
        links = _links(columns.situation, place)
        grown = columns.stretch[:, :, links].sum(axis=2)
        return (grown * shaped(columns.situation, place)[:, None])[:, :, None]

    def sentence(self, place, parameters):
        what = f"Link {place.where['link']} grows" if "link" in place.where else "All links grow"
        return f"{what} with {place.where['driver']}: {quantity(parameters[0])} of the length."


def _links(situation, place) -> list[int]:
    return [place.where["link"] - 1] if "link" in place.where else list(range(situation.joint_count))


EFFECT = ThermalGrowth()
