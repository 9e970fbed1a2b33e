"""When measured angles trail the commanded ones."""

from __future__ import annotations

#: s: a command is followed within a second, or not at all.
LATEST = 1.0

#: Standard deviations by which a lag must differ from none.
SURE = 5.0

#: Part of a sampling step: less is the rounding of the time stamps.
LEAST = 0.05

#: Part of the held-out error that may be left: what is no lag stays.
FALLS = 0.7

#: rad or m: a command, or a joint, that moves by less tells no time.
MOVED = 1e-3
