"""Joint logs over time: what friction, loads, delays and contacts a rigid-body description leaves out.

log.py, checks.py     the recording as arrays; what cannot be used is refused or set aside
filters.py            zero-phase speed and acceleration, the window chosen by risk
sampling.py           windows, the description's columns, blocks of time
prior.py              how far the description's masses are believed
library.py, curves.py laws and free curves as columns
noise.py, whitening.py  size and memory of the noise
system.py, joint_system.py  Gram matrices block by block
scoring.py, batches.py, directions.py  scores and their null under sign flips
search.py, locate.py, bending.py, heldout.py  forward selection
refining.py           laws and times looked at again together
friction.py           a joint's friction chosen as a set
repeats.py            a trajectory that runs again: noise without physics
corrections.py        what is undone in the samples and looked at again
uncertainty.py        spreads where structure is left
commands.py           the lag between command and answer
next_motion.py        what to record next
judged.py             learnt on one run, judged on others
exact.py              refit with the exact laws
names.py              what may be named, what is left over
findings.py           the result
confirmed.py          what was named, refitted without what was withheld: the saved model
remains.py            what is left, against the stated noise
study.py              one log in rounds; baseline.py: what a reference run teaches
gains.py, suspects.py drive gains that nobody gave; columns that are not what they are called
engine.py             the order of all this
"""

from app.diagnosis.motion.engine import diagnose
from app.diagnosis.motion.judged import STEPS, Judged, judged_on

__all__ = ["STEPS", "Judged", "diagnose", "judged_on"]
