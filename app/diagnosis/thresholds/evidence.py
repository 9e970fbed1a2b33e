"""What a group costs and must bring, in nats of log evidence: log of the ratio by which the data favour a model."""

from __future__ import annotations

import numpy as np

#: nats that a law at one place must earn beyond its own flexibility: there are about 150 laws and places, so by
#: chance the best of them earns ln 150 = 5.
LAW = 5.0
#: nats of a family (all zeros, all lengths, ...): one decision with many parameters, rarer than a single law.
FAMILY = 8.0
#: nats of a smooth law without a name: what has a name is preferred where both explain the same.
UNKNOWN = 8.0
#: nats of a change at a row, beyond ln(rows) for the choice of the row.
STEP = 7.0
#: nats beyond its penalty that a group must bring to be taken (odds of 20 to 1), and below which it falls again; the
#: gap keeps a group from being taken and dropped in turn.
TAKE, DROP = 3.0, 2.1
#: nats by which an exchange or a joint start must be better to be preferred: below it rounding would decide.
BETTER = 0.5
#: Passes of exchanges at most: each but the first starts from what the one before has changed.
EXCHANGES = 4
#: Cosine between two columns beyond which one can hide the other: their sum leaves half of either or less.
PAIR_COSINE = 0.7
#: Natural logarithm of variances: whatever an arm is off by, it is off by about its usual size, to a factor of two at
#: one sigma, and zeros, lengths and angles of one arm by about as many of theirs, because they come from the same shop
#: and the same care. Without it few rows in a part of the workspace, where one kind looks like another, learn any size.
LIKENESS = 2.0 * float(np.log(2.0))
#: nats by which a description of few laws may be behind one of families before exchanges of its laws are tried: five
#: laws that were taken one by one change places for tens of nats, an arm that is off everywhere is ahead by hundreds.
FAR_BEHIND = 100.0
#: Measured components a family parameter must have at least for families to be tried as a whole.
COMPONENTS_A_PARAMETER = 3

#: Learnt widths, as variances in units of the noise variance: from a thirtieth of the noise to 2,000 times.
WIDTHS = 10.0 ** np.arange(-3.0, 6.6, 0.3)

#: Groups of a sparse description from which on all families at once are tried too.
DENSE_FROM = 5

#: nats that the best law must bring for a scan for events, which is dear, to wait.
SCANNED_BELOW = 300.0

#: Relative: friction of one arm from log to log, as it warms up and is greased.
DRIFT = 0.15

#: Drive gains between two logs, over what makers' gains differ by: one drive keeps its gain to some percent.
SAME_DRIVE = 0.1

#: One sigma of the share by which the gains of a maker's drives differ from what he states.
GAIN_SPREAD = 0.03

#: Factor of a torque, less one, that drives and masses as they are made have among them: three times what drives differ
#: by, half of what a link's masses are off by.
SMALL_FACTOR = 0.1

#: `# inertials:` -> how far the masses may be off, over the nominal trust of 20% a link.
TRUSTS = {"exact": 0.01, "cad": 1.0, "unknown": 10.0}

#: That nominal trust: share of a link's mass by which a description from a drawing may be off, one sigma.
NOMINAL = 0.2

#: nats of a whole family of a joint log: one decision with many parameters, asked of thousands of rows.
LOG_FAMILY = 4.0

#: Marginality: ridge on the lower columns [noise variances over nominal sizes squared]; they may take three nominal
#: sizes.
RIDGE = 1.0 / 9.0

#: Variances of a law's parameters over those of their nominal widths that are tried.
LAW_WIDTHS = np.array([1.0, 25.0])

#: Variances of laws that every joint may have, all joints at once, over those of their nominal widths.
FAMILY_WIDTHS = np.array([0.01, 0.1, 1.0, 10.0, 100.0])
