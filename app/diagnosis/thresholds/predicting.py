"""When one description of a joint log predicts it better than another: errors on stretches left out."""

from __future__ import annotations

#: Share of the held-out error by which another description must be better to be taken instead.
PLAINLY = 0.005

#: Nepers of the joints' held-out errors, summed, that a law must be worth where structure is left: less is chance.
WORTH = 0.002

#: Variance of masses, friction, offsets and rotors of all joints, over that of their nominal widths: what they are
#: trusted to before anything is measured.
TRUSTED = 1.0
