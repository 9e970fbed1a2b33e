"""Where the tool sits in the flange, and how well that is known.

    captures.py     what a wizard records: Step, Capture, Mode
    points.py       the same from a points file
    sockets.py      one tool, many touched points: leave-one-placement-out
    result.py       ToolCalibration: tool frame, residuals, covariance, warnings
    tool.py         captures -> ToolCalibration, the one road every mode takes
    orientation.py  the tool's axes from strokes and sightings
    solvers/        the tool point: one file an estimator
    modes/          one file a wizard mode
    vocabularies/   one file a maker's words for the same modes
    quality/        uncertainty, leave-one-out, rounding, traffic light
    checks/         one file a thing that can go wrong, with the advice
    next_touch/     where to touch next, and what it would bring
    verify.py       turns about the accepted tool point
    report/         one sheet of paper
    exchange/       one file a format that tool frames travel in
    wording/        what all of these say, in English and Chinese
    base/           base frames by tracker

Model of a touch: `R_i t + p_i = s + e_i`; `R_i, p_i` the flange in base, `t` the tool point in the flange,
`s` the touched point in base, `e_i` the touch's own error, alike in all directions.
"""
