"""The tool point from touches of one fixed point: one file an estimator.

    joint.py      tool point and touched point together; the order of the touches does not matter
    pairwise.py   Xiong 2012: neighbouring touches; the order matters
    robust.py     as joint, but far-off touches count less; none is dropped

Each is `solve_…(rotations (n, 3, 3), positions (n, 3)) -> PointFit`.
"""
