"""What an effect can follow, and how far what was learnt holds."""

from __future__ import annotations

#: K: a temperature that varies by less than this drives nothing.
STEADY = 0.5

#: Sum of squared steps over sum of squared deviations: 2 for white noise, near 0 for a slow curve (von Neumann 1941).
JUMPY = 1.0

#: Time constants that are tried, as parts of the recording's length: a warm-up that settles within it.
SETTLING = (0.15, 0.4)

#: Rad or m beyond the joint ranges in which an unnamed part was learnt that it still holds, and the share of the rows
#: that must stay within. The ends of ranges that sixty random poses span lie a tenth of a radian short of the limits.
BEYOND, INSIDE = 0.3, 0.85

#: Share of the taught poses whose nearest neighbour is as near as what counts as near, and share of a recording's rows
#: that must be near a taught pose for it to be of the same poses. Of poses drawn like those taught nine in ten are.
NEAREST, ALIKE = 0.9, 0.4
