"""When a recording of poses was written down by another convention."""

from __future__ import annotations

import numpy as np

from app.units import DEG_PER_RAD, from_mm

#: Misfit [m] that base and tool must leave before conventions are tried: a joint counted the other way, another unit
#: or order moves the tip by centimetres; below 2 mm nothing of the kind can be there unless the joint hardly moves.
CONVENTION_MISFIT = 2e-3
#: nats that a convention must earn: it is one choice among some sixty, and rarer than any fault of an arm.
CONVENTION = 20.0
#: Rows that are enough to tell one convention from another.
CONVENTION_ROWS = 120
#: Share of the misfit that is left at most where measurements stand in other rows than their joints: then the right
#: rows explain nearly all. In a recording made in motion any delay makes the row beside fit a little better.
BESIDE = 1.0 / 3.0
#: Conventions undone at most in one recording.
CONVENTIONS = 4

#: A joint that moves by less than this, in radians, may have been written in radians under a name in degrees.
JOINT_HARDLY = 4.0 * np.pi / DEG_PER_RAD

#: What base and tool leave must fall to this share before another unit is believed.
FALL = 1.0 / 3.0

#: What no fault of an arm leaves: beyond it the recording is of another arm, or written down wrongly.
GROSS = from_mm(20.0)

#: nats within which two conventions explain the same; then the commoner mistake is named and the others listed.
ALIKE = 6.0

#: rad: a recording that never leaves this was written in degrees and read as less; one beyond TURNS, the reverse.
HARDLY, TURNS = 0.2, 4.0 * np.pi

#: A correlation with gravity that is stronger than this, and negative, is the controller's sign and no accident.
OPPOSED = -0.5

#: rad: no controller shows more than two turns beyond a limit.
WAY_OUT = 4.0 * np.pi

#: m: no instrument of this kind measures farther.
FARTHEST = 100.0

#: s between rows, in the mean: a person or a program that waits for an arm to stop and settle takes longer.
IN_MOTION = 0.5

#: Part of the usual step: rows that are stamped closer have one moment.
AT_ONCE = 0.1

#: Share of the rows that are stamped together with the one before, from which on the stamps are a buffer's.
BURSTS = 0.3

#: s by which measurements and joints of two devices are apart at most: half a second of buffers and filters.
MOST_APART = 0.5

#: s between the delays that are tried first: half of it at 0.5 rad/s and 1 m is 6 mm, from where the best is found.
DELAY_STEP = 0.025

#: s: delays that differ by less are one; at 1 m/s that is a micrometre.
DELAY_SURE = 1e-6
