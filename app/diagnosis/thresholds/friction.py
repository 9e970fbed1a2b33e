"""How sharply dry friction turns over at rest."""

from __future__ import annotations

#: Widths that are tried, over the sharpest.
WIDER = (1.0, 2.5, 6.0, 15.0, 40.0)

#: nats by which a wider one must be better: a blunt turn changes every law of friction beside it.
SURE = 10.0

#: Rows that hang together and count as one.
TOGETHER = 4.0

#: Parts of a usual speed: friction that fades with it must not be taken for a blunt turn.
STRIBECK = (0.03, 0.12)

#: Times the sharpest turn of friction, or the noise of the speed, below which a joint stands still.
STILL = 2.0

#: Sharpness of the direction of dry friction where a log does not tell it [rad/s or m/s].
SHARP = 2e-3
