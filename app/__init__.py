"""Teachframe: a teach pendant in the browser that also finds the physics a simulation left out.

Every arrow points down; nothing lower knows anything higher (tests/test_architecture.py holds it).

    __main__      the only place where everything is wired
    cli           one file a command
    pendant       the browser: scene, theme, texts; one file a screen        only here: viser
    training      exercises, hidden truth, scoring
    session       frozen state, actions (state -> state), append-only journal
    proof         draws sealed cases with a forward model of its own and scores the diagnosis
    simulation    the world a trainee works in: true tool, spike, touch, laser tracker
    diagnosis     recording + robot -> where, what, model, improvement
    calibration   tool and base frames; quality; next touch; verification
    recordings    frozen tables with units; formats/ one file a format
    kinematics    robot models, inverse kinematics, collision                only here: pin, coal
    estimation    Fit: parameters with covariance, rank and condition
    geometry      rotations, poses, angle conventions
    catalog, resources, phrases, errors, units

Notation: `T_base_tool` maps tool coordinates into base, so names cancel from inside. `R_a_b`, `p_a`,
`q` likewise; plurals (`Ts_`) are batches. Inside: metres, radians, seconds, newton-metres, no suffix.
At the edges a suffix is mandatory: `_mm`, `_deg`. Quaternions are wxyz.
"""

__version__ = "0.1.0"
