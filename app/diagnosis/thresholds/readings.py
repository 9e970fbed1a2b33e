"""When a joint log is to be read otherwise than it says: mounting, senses, order, units, clock."""

from __future__ import annotations

#: Samples that are looked at: enough to tell readings apart that differ grossly.
LOOKED_AT = 500

#: Rows that hang together count as one.
TOGETHER = 5.0

#: Nepers of the residual, mean over the joints, by which a reading must be better.
BETTER = 0.35

#: nats of a reading: a few hundred are tried, and a wrong one takes everything after it along.
COST = 25.0

#: Share of the torques left unexplained below which nothing is asked.
GROSS = 0.02

#: Of the share left before, that a reading may leave: a wrong one takes some of a load along.
LEAVES = 0.5

#: Share that a factor of every joint may leave: so many factors imitate a load in part.
EACH_LEAVES = 0.05

#: Degrees of a mounting that is undone before the search; less is left to it.
TILTED = 8.0

#: Factor of all torques, or of each joint, that is undone before the search; less is left to it.
FACTOR = 1.8
