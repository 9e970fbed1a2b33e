"""Where a tool point is: the arm, the cell around it and the instrument.

situation, geometry, gravity, pace    drivers that errors can follow, and directions they take
cell, setup                           the exact forward model, and what every recording leaves open
sensitivity, nuisance                 linear columns of everything that can differ
terms, refit                          effects with values, fitted by Gauss-Newton with their learnt widths
hypotheses                            conventions of the whole recording
saved, predict                        a saved model, and where it puts the arm
"""
