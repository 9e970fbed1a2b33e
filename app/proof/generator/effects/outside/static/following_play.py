"""Play that is wider than most moves: the link is dragged along and remembers where it was left."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.outside.static._along import JointCurve


@dataclass(frozen=True)
class FollowingPlay(JointCurve):
    key: str = "following_play"

    def curve(self, cell, j):
        q = cell.q[:, j]
        width = 0.35 * np.ptp(q)
        place = np.empty_like(q)
        place[0] = q[0]
        for i in range(1, len(q)):
            place[i] = np.clip(place[i - 1], q[i] - width, q[i] + width)
        return (place - q) / max(width, 1e-9)


EFFECT = FollowingPlay()
