"""When a part of the fit is a finding by name."""

from __future__ import annotations

#: nats within which a rival is listed: 2 nats * 4.6 = 9.2 in BIC, odds of 100 to 1.
RIVAL = 4.6
#: Wald statistic (in sigma, squared) beyond which a member of a family is a finding of its own, and what every
#: further parameter of it adds. Six sigma hold through the 150 places and the imperfect noise of real instruments.
MEMBER_WALD, MEMBER_WALD_PARAMETER = 36.0, 2.0
#: The same where calibration and mechanisms share alike: three sigma, for there a member has all its rivals beside it.
MEMBER_SHARED = 9.0
#: Poses that each name asks for: with fewer a fit of many members says nothing of the single one. Ten observations a
#: variable: Harrell, "Regression Modeling Strategies" (2001), 4.4.
POSES_A_NAME = 10
#: A member must move the measured points by this share of the noise (rms), else nobody would see it.
MEMBER_MOVES = 0.3
#: Share of the mean square of `before` that unnamed parts may take while the verdict is still "named".
UNNAMED_SHARE = 0.02
#: Sum of the families' shares beyond which they cancel each other: two that each explain all of it only together are
#: bending to something that is neither.
CANCELLING = 1.5
#: Share of a finding's own movement that an unnamed part at the same joint and driver may have beside it.
SAME_PLACE_SHARE = 0.5

#: p of a reading of the whole recording that takes most of its misfit away.
CERTAIN = 1e-300

#: Share of a column's length that the set-up must leave for it to be seen: what shows by less than a fiftieth of itself
#: takes its value from rounding, and would be carried to other poses fifty times enlarged.
SEEN = 0.02
