"""Linear regression with learnt prior widths, over Gram matrices. Knows no robot.

design.py       whitened columns, everything free projected off their Gram matrix
groups.py       columns that are in or out together
evidence.py     log evidence of a set of groups; gains of all others; posterior
solved.py       factor, posterior, what is left beside a selection
inside.py       what each group of a set is worth beside the others
triangular.py   small triangular systems
heldout.py      error on folds left out, from Gram matrices by fold
nulls.py        what chance reaches: sign flips of the residual
"""
