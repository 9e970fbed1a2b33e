"""When a joint is asked whether it twists: what must ring, how loud, and how well it must be told."""

from __future__ import annotations

#: Samples in a period of a resonance below which its swing is not followed: a line between samples cuts its peaks off
#: by a seventh there.
A_PERIOD = 6.0

#: Hz: below it motion itself and a resonance are not told from each other; arms ring at 4 Hz and above.
SLOWEST = 2.5

#: nats by which a resonance must explain the band around it better than the rigid torque alone, in the quick look;
#: of 40 places that are tried, the best reaches 8 by chance.
HEARD = 11.0

#: nats it must be better by in the search over time, beside all else that the joint may have, rows counted as if they
#: were independent. In real logs they hang together and models are not complete: on a UR10e 18 made a name by which the
#: log was predicted worse, and a joint heard with 49 predicted it better. Springs that were put in have 44 and more.
FOUND = 35.0

#: Share of the described link that swings: far from one, what rings is not the link on the joint's spring.
SHARE = (0.5, 1.6)

#: Nepers of standard deviation up to which a stiffness is known; beyond, nothing rings, or too faintly.
KNOWN_STIFFNESS = 0.1

#: The same of the damping, which a log tells less well.
KNOWN_DAMPING = 0.5

#: Standard deviations by which what a twist gives under load must differ from nothing, where both sides are recorded.
SURE = 5.0

#: Part of the held-out difference of the two angles that may be left: what follows no load is no spring's.
FALLS = 0.7

#: Share of the damping at which nothing rings: more than this leaves one swing at most.
DAMPED = 0.6
