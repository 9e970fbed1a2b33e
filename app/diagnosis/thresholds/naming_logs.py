"""When a law of a joint log is a finding by name."""

from __future__ import annotations

#: nats that a name must bring beyond its penalty: the noise of a joint log is a model of a spectrum.
NAME = 10.0

#: Share of the mean square of `before`, above noise, below which a law is folded into its family and no name, where the
#: model is not complete: what is left over is larger, and small laws bend to it.
SHARE = 0.02

#: Share of what a law explains that an unnamed curve along the same driver may explain beside it.
CURVE = 0.3

#: Waves of one joint's own angle beyond which they make up a shape, and none of them is a name.
RIPPLES = 2

#: Against a reference, of the held-out error: what changes it less is no change.
CHANGE = 0.01

#: Share below which a family without a finding is not listed in the budget.
LEAST = 1e-3

#: Where structure is left on its joint, a law must explain so many times as much as is left.
STANDS_OUT = 3.0

#: Root mean square of a link's change in units of the trust stated for it beyond which it is a finding.
TRUST = 1.0

#: Part of the torques' spread left beyond which they do not belong to this arm at all.
HOPELESS = 0.8

#: Relative standard deviation of a motor's gain beyond which it is not used.
MOST_UNSURE = 0.08

#: One sigma of the share by which a link as a whole may be heavier or lighter than described: what was drawn was cast
#: otherwise, a cover was left out.
HEAVIER = 0.3

#: One sigma of a load's mass, over the arm's; its centre is as far from the link's frame as the link is large.
LOAD_MASS = 0.1

#: nats by which a load on a link must explain its masses better than a link that is heavier itself: odds of 20 to 1,
#: for links are off in every arm and loads on them are rare.
LOAD_SURE = 3.0

#: Standard deviations by which a load on a link must be above nothing: else the motion shows a moment and no mass.
WEIGHED = 3.0

#: Mean square of what is left, over that of the noise, beyond which something is missing that a load on a link whose
#: weight the log leaves open may only stand in for: half of what is left is then no noise.
INCOMPLETE = 2.0
