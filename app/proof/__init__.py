"""Sealed cases: drawn apart from the search, answered by it as a black box, scored by rules written down.

generator/    arms, effects and recordings with a forward model of its own; knows nothing of the diagnosis
strata/       which cases are drawn, one file a stratum
whole.py      when an answer about an arm that is off everywhere is right
matching.py   when an answer is right: every rule and every inherent alias, in one place
"""
