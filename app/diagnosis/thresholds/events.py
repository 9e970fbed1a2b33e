"""When something happened in the middle of a joint log, and how long it must last."""

from __future__ import annotations

#: Part of the log's motion before a change of load, while it lasts and after it: less cannot be told from the log's
#: ends, and what is held for less is a push.
EDGE = 1 / 12

#: Part of the log that a contact may last: what lasts longer is a load or a posture, and would not carry over.
LONGEST = 1 / 4

#: Events of a log that are looked for: more of them are a log of another kind.
MOST = 3

#: nats by which an event must beat what else could be taken.
MARGIN = 12.0

#: s: a contact lasts longer.
SHORTEST = 0.1

#: nats that two events of one kind may be better than one of them, moved, and are one still.
MERGE = 8.0
