"""When one description of a joint log predicts it better than another: errors on stretches left out."""

from __future__ import annotations

#: Share of the held-out error by which another description must be better to be taken instead.
PLAINLY = 0.005

#: Nepers of the joints' held-out errors, summed, that a law must be worth where structure is left: less is chance.
WORTH = 0.002

#: Variances of masses, friction and rotors, over those of their nominal widths, that come next to least squares.
WIDE = 1e4

#: The same, of masses and friction that are taken for near the description the less the log tells of them.
CLOSER = (100.0, 1.0, 0.01)
