"""When a motion or a pose counts as repeated, so that its differences are noise."""

from __future__ import annotations

#: Degrees of freedom below which repeats say too little.
LEAST_REPEATS = 8

#: Part of each joint's own spread: so near the second run must follow the first.
SAME = 0.01

#: Part of the log: less is no run.
SHORTEST = 0.05

#: Part of the log that must have a partner.
LEAST = 0.25

#: Times the robust spread of the differences: more is no noise.
CHANGED = 1.5
