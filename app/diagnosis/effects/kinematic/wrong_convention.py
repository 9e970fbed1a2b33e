"""The recording itself is written down wrongly: a joint's sign, two joints changed over, a unit, an inverse."""

from __future__ import annotations

from app.diagnosis.effects.kinematic._base import KinematicEffect
from app.diagnosis.observations.conventions import converted_joints, title_of


class WrongConvention(KinematicEffect):
    """Not searched by columns (it is far from linear) but as a hypothesis of the whole recording: see
    observations/conventions.py and models/kinematic/hypotheses.py."""

    key = "wrong_convention"
    title = "Written down in another convention"
    equation = "q_true = -q, or joints, units or directions changed over"
    family = "conventions"
    undone = True

    def places(self, situation):
        return []

    def quantities(self, situation, place):
        return ()

    def apply(self, cell, situation, place, values):
        return cell.with_joints(converted_joints(cell.q, place.fixed, situation.time))

    def columns(self, columns, place):
        return columns.joint[:, :, :0]

    def sentence(self, place, parameters):
        return f"The recording is written down in another convention: {title_of(place)}."


EFFECT = WrongConvention()
