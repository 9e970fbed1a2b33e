"""A link, or every link, grows as the arm warms up."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.effect import Place, Quantity, StaticEffect, joints, number
from app.diagnosis.static.pace import pace, paces, per_unit

_SHORTEST = 0.02  # m: shorter links do not grow by anything that shows


class ThermalGrowth(StaticEffect):
    key = "thermal_growth"
    title = "Links grow as the arm warms up"
    equation = "length = length_nominal * (1 + rate * (t - t0))"
    rank = 38
    curve = "pace"

    def places(self, situation):
        long = np.linalg.norm(situation.links.lengths, axis=1) > _SHORTEST
        for driver in paces(situation):
            yield Place({"driver": driver})
            for k in joints(situation):
                if long[k - 1]:
                    yield Place({"link": k, "driver": driver})

    def quantities(self, situation, place):
        return (Quantity("rate", "1" + per_unit(situation, place)),)

    def apply(self, cell, situation, place, values):
        growth = values[0] * pace(situation, place)
        for k in _links(situation, place):
            cell = cell.add_link(k, growth[:, None] * situation.links.lengths[k], np.zeros(3))
        return cell

    def columns(self, columns, place):
        links = _links(columns.situation, place)
        grown = columns.stretch[:, :, links].sum(axis=2)
        return (grown * pace(columns.situation, place)[:, None])[:, :, None]

    def sentence(self, place, parameters):
        what = f"Link {place.where['link']} grows" if "link" in place.where else "All links grow"
        return f"{what} with {place.where['driver']}: {number(parameters[0])} of the length."


def _links(situation, place) -> list[int]:
    return [place.where["link"] - 1] if "link" in place.where else list(range(situation.joint_count))


EFFECT = ThermalGrowth()
