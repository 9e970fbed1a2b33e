"""Where a recording and the robot's description differ: where, what, the model of it, and the improvement.

result.py     Diagnosis, Finding, Evidence: what both engines give, and its JSON
model.py      the saved model: effects with values, loaded by simulation, pendant and diagnosis
static/       the engine for touches and tracker points
motion/       the engine for joint logs over time
effects/      static/ and motion/: one file an effect
report/       the same as a page
"""
