"""A smooth difference in time without a known law, of a joint or of the base; it belongs to its recording alone."""

from __future__ import annotations

from app.diagnosis.effects.effect import Level
from app.diagnosis.effects.kinematic._base import KinematicEffect, Place, Quantity, joint_driver, joints
from app.diagnosis.effects.kinematic._smooth import cosines, smoothness
from app.diagnosis.models.kinematic.body import moved_base
from app.diagnosis.thresholds.evidence import UNKNOWN

#: rad (or m): size of its slowest wave.
_WIDTH = 3e-4
#: Cosines over the recording.
_COUNT = 10


class UnnamedDrift(KinematicEffect):
    """q_true = q + curve(t), or the base displaced by a curve of time in each direction."""

    key = "unnamed_drift"
    title = "A difference that wanders in time, without a known law"
    equation = "q_true = q + curve(t), curve a sum of cosines"
    family = "unnamed"
    level = Level.UNKNOWN
    penalty = UNKNOWN + 1.0  # below play and drift, which are commoner
    cap = 30.0
    lasting = False

    def places(self, situation):
        span = {"low": float(situation.time.min()), "high": float(situation.time.max())}
        for where in (*({"joint": j} for j in joints(situation)), {"body": "base"}):
            yield Place({**where, "driver": "time"}, span, member=False)

    def quantities(self, situation, place):
        sizes = _WIDTH * smoothness(_COUNT)
        axes = ("",) if "joint" in place.where else ("x", "y", "z")
        return tuple(Quantity(f"c{axis}{k + 1}", "1", float(s)) for k, s in enumerate(sizes) for axis in axes)

    def apply(self, cell, situation, place, values):
        curve = _curve(situation, place)
        if "joint" in place.where:
            return cell.add_joint(place.where["joint"] - 1, curve @ values)
        return moved_base(cell, curve @ values.reshape(_COUNT, 3))

    def columns(self, columns, place):
        curve = _curve(columns.situation, place)
        if "joint" in place.where:
            return joint_driver(columns, place.where["joint"], curve)
        out = curve[:, None, :, None] * columns.base[:, :, None, :3]
        return out.reshape(*columns.base.shape[:2], -1)

    def sentence(self, place, parameters):
        what = f"The zero of joint {place.where['joint']}" if "joint" in place.where else "The base"
        return f"{what} wanders in time, by no known law."


def _curve(situation, place):
    return cosines(situation.time, place.fixed["low"], place.fixed["high"], _COUNT)


EFFECT = UnnamedDrift()
