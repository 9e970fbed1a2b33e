"""Touches and tracker points on the engine: the order of work from a table to a diagnosis.

description  what a recording was described as
describe     few laws or families, the exact refit, rows weighted anew
levels       marginality between levels of laws
hypotheses   conventions of the whole recording, by evidence
spread       how far values may be off
findings     names, rivals and p values
budget       where the millimetres come from
judging      a saved model on a recording: the one source of every "before" and "after"
diagnose     the whole
"""
