"""Where a recording and the robot's description differ: where, what, the model of it, and the improvement.

dispatch, judging, preview    one recording to one diagnosis; a model on a recording; a look before any search
result, model                 what is said, and its JSON; the saved model, loaded by simulation, pendant and diagnosis
thresholds                    the numbers that decide
kinematic/, dynamic/          the order of work for touches and tracker points, and for joint logs
selection/                    add, drop, swap, pairs; change points
regression/                   designs, evidence, held-out errors, nulls; knows no robot
effects/                      one base; kinematic/ and dynamic/: one file is all an effect needs
models/                       kinematic/ and dynamic/: exact prediction and linear columns
observations/                 what was recorded, checked
report/, export/              pages and text; what a simulator reads
"""
