"""Teachframe: a teach pendant in the browser that also finds the physics a simulation left out.

Every arrow points down; nothing lower knows anything higher (tests/test_architecture.py holds it).

    __main__      the only place where everything is wired
    cli           one file a command
    shell         the pendant's web page and its server                       only here: Starlette
    workers       what lives as long as a session is open: wires session, scene and screens
    screens       one file a tab of the page; what it gets is a Context
    scene         the cell in 3D                                              only here: viser
    panel         what stands on a screen, as plain data
    classroom     lessons assigned, progress, live state, hints, exercises made here
    people        accounts, classes, log-ins, the table of doors                only here: argon2
    training      exercises, hidden truth, scoring
    session       frozen state, actions (state -> state), append-only journal; motion/ the arm's drive
    fleet         many recordings, on all cores or on a cluster               only here: Dask
    proof         draws sealed cases with a forward model of its own and scores the diagnosis
    simulation    the world a trainee works in: true tool, spike, touch, laser tracker
    diagnosis     recording + robot -> where, what, model, improvement
    calibration   tool and base frames; quality; next touch; verification
    recordings    frozen tables with units; formats/ one file a format
    kinematics    robot models, inverse kinematics, collision                only here: pin, coal
    estimation    Fit: parameters with covariance, rank and condition
    geometry      rotations, poses, angle conventions
    texts         what the pendant says, a file a language
    apart         a job in a process of its own, with bounded time and memory
    templating    templates of pages, sheets and reports; every text is escaped
    catalog, resources, phrases, steps, errors, units

Notation: `T_base_tool` maps tool coordinates into base, so names cancel from inside. `R_a_b`, `p_a`,
`q` likewise; plurals (`Ts_`) are batches. Inside: metres, radians, seconds, newton-metres, no suffix.
At the edges a suffix is mandatory: `_mm`, `_deg`. Quaternions are wxyz.
"""

__version__ = "0.1.0"
