"""How sharply dry friction turns over at rest."""

from __future__ import annotations

#: Widths that are tried, over the usual one: a simulator's friction, or one of rolling bearings, turns sooner.
WIDER = (0.1, 0.25, 0.5, 2.5, 6.0, 15.0, 40.0)

#: nats by which a wider one must be better: a blunt turn changes every law of friction beside it.
SURE = 10.0

#: Ways over which friction turns that are tried, parts of the joint's travel: gears give way by minutes of arc before
#: they slide, the joint itself by degrees.
SLIPS = (3e-4, 1e-3, 3e-3, 1e-2, 3e-2)

#: Steps to either side by which the best of them is refined: they stand three times apart.
FINER = (1.7, 1.3, 1.14)

#: Most that one row is taken to keep of the noise of the row before: beyond, a slow course of the torque counts
#: nothing.
MEMORY = 0.95

#: Rows that hang together and count as one.
TOGETHER = 4.0

#: Parts of a usual speed: friction that fades with it must not be taken for a blunt turn.
STRIBECK = (0.03, 0.12)

#: Times the sharpest turn of friction, or the noise of the speed, below which a joint stands still.
STILL = 2.0

#: Sharpness of the direction of dry friction where a log does not tell it [rad/s or m/s].
SHARP = 2e-3

#: Times the sharpness of the turn at rest: what fades over less speed is that turn, and no Stribeck friction.
BLUNT = 2.0
