"""Which rows and samples count, and which are set aside."""

from __future__ import annotations

from app.units import from_mm

#: Weight of a row under the t distribution below which it is set aside and named as an outlier.
OUTLIER_WEIGHT = 0.05
#: Share of the rows that may be set aside while the others are still called a description: more is structure.
OUTLIER_SHARE = 0.1
#: Degrees of freedom of the t distribution of residuals: heavy enough for one wrong row in ten.
ROBUST_DOF = 4.0
#: Rows between two changes below which they are one that takes its time to come about, or outliers.
STEP_GAP = 6
#: Rows, and share of the rows, at either end in which no change is looked for: too few to tell it from outliers.
STEP_EDGE, STEP_EDGE_SHARE = 6, 0.08

#: A row of ordinary size counts fully: weights are raised by this and cut at one.
HEADROOM = 1.3

#: What a row that is set aside still weighs: targets touched once more stay defined.
ALMOST = 1e-4

#: Share of rows that may be out of order before a log is refused.
MOST_BACKWARDS = 0.02

#: Times the joint's speed limit beyond which a jump is no motion.
FASTEST = 4.0

#: Robust standard deviations by which a torque leaves the mean of its two neighbours, to be a spike.
SPIKE = 8.0

#: ... and times what its neighbours leave theirs by: runs are structure.
ALONE = 1.5

#: Samples of a running median: up to four spikes in a row are none of the median's business.
SPIKE_WINDOW = 9

#: Share of a joint's rows that may be spikes: more is how it moves.
MOST_SPIKES = 0.02

#: rad/s, m/s: speed limit where the description states none.
FALLBACK_SPEED = 10.0

#: Share of unusable rows above which a log is refused.
MOST_BROKEN = 0.6

#: Usable samples that a joint log must have.
FEWEST = 60

#: Sampling steps without a sample that end a run.
GAP = 6.0

#: s over which temperatures are averaged: a gear warms more slowly.
WARMING = 2.0

#: Rows of poses that base and tool need at least.
LEAST_ROWS = 6

#: m: digits finer than this hardly repeat by chance, not in three coordinates at once.
FINE = from_mm(0.02)
