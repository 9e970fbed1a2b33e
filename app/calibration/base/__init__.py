"""Where a robot's base stands, seen by a laser tracker, from axis 1 and axis 2 turned alone.

    arcs.py       what was recorded: one arc an axis, with rows and stated noise
    frame.py      two axes -> base frame with covariance, for any number of cells at once
    sense.py      which way an axis points: the direction of turning
    arcfit.py     one arc's circle, its rows set aside, its noise
    checks/       one file a thing that can go wrong, with its code
    solve.py      arcs -> BaseCalibration, the one road
    maker.py      the constant step from the frame found to the maker's own
    relation.py   two robots: T_base1_base2, and the error where both tools meet
    batch.py      many cells at once, for studies
    sixaxis.py    every axis turned: lengths and twists of the real arm beside its description
    poses.py      the base from tracked poses instead of arcs
    wizard.py     the procedure as steps: state in, state out
    result.py     BaseCalibration and what it says of itself; report.py, the text and the JSON

The frame is the patent's: Z along axis 1, X along the common perpendicular of axes 1 and 2 towards the work
space, origin where that perpendicular meets axis 1, so at the height of axis 2.

Source: Wang, Zhang, Zhou, Zhang, Zheng, Zhou, patent of S. China Univ. of Technology (2017), "base frame
calibration of dual robots by laser tracker".
"""
