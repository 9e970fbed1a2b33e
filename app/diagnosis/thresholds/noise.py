"""How loud the noise is, and when more is left than noise."""

from __future__ import annotations

#: Sigma by which the residual must exceed a noise that is known (stated, or from repeats) before it counts as
#: structure; 1.5 allows for tails heavier than normal.
EXCESS_SIGMA, HEAVY_TAILS = 4.5, 1.5

#: m: what no fault of an arm leaves beside a full description: measurements and poses do not belong together, and no
#: name is given.
HOPELESS = 5e-3

#: How seldom noise alone may make orientation and points disagree so far on an arm, over all its directions.
CHANCE = 0.01

#: Sign flips for family-wise p values; the smallest p is one over one more.
NULLS = 199

#: Hz, and share of the sampling rate: between them ends the band of the motion.
BAND = (0.8, 0.12)

#: It ends at so many times the frequency below which this share of the motion's energy is.
BAND_ENERGY, BAND_ABOVE = 0.999, 2.0

#: Part of the sampling rate: beyond, a periodogram is folded.
HIGHEST = 0.48

#: Part of a band's frequencies that stays free, whatever was fitted.
LEAST_SHARE = 0.4

#: Times the middle one by which a stretch of a log is louder, to be something that happened: what a model leaves out
#: comes and goes with the motion by a factor of two or three.
BURST = 5.0

#: Share of a log's stretches that may be louder so: more is how the log is.
MOST_BURST = 0.25

#: p below which, and ratio to the noise beyond which, a joint has structure left in the band of its motion.
LEFT_P, LEFT_RATIO = 2e-4, 1.7

#: s of a stretch whose scores are summed (block sandwich), and fewest and most of them.
STRETCH, FEWEST, MOST = 2.0, 12, 40
