"""One joint whose friction others have modelled: their published figures beside the same forms fitted here, and the
diagnosis.

    python -m benchmarks joint_friction [--write]

Root mean square of what the torque leaves, over all rows, as published for the same log (NNFM, the README of
longshike/NNFM-A-Novel-Neural-Network-Modeling-Approach-for-Robot-Flexible-Joints-Friction); how those forms were fitted
is not said there. The forms fitted here learn from all rows too; held out, by stretches of time, stands beside.
"""

from __future__ import annotations

import sys
from collections.abc import Callable

import numpy as np
from scipy.optimize import least_squares

from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.dynamic.ready import ready
from app.diagnosis.models.dynamic.hypothesis import as_given
from app.diagnosis.models.dynamic.samples import take
from app.recordings import read_table
from app.recordings.arm import robot_for
from benchmarks._document import DOCS, markdown, replace_section
from benchmarks._ordinary import columns, fit, time_folds
from benchmarks.real_static import data_folder
from benchmarks.rows import Row

LOG = "panda_joint_motion/run_a.csv"
#: Published root mean square [Nm], by form.
PUBLISHED = {
    "constant and viscous friction": 0.386,
    "Stribeck friction": 0.381,
    "LuGre friction": 0.375,
    "transformer network": 0.164,
    "physics-informed network": 0.131,
    "their own network (NNFM)": 0.100,
}
_LEAST, _START, _MOST = (-20, -20, -20, 1e-3, -20), (0.2, 0.2, 0.1, 0.1, 0.0), (20, 20, 20, 5.0, 20)

#: Learns on some rows, and gives the torque left on others: (learnt on, judged on) -> (rows,).
Left = Callable[[np.ndarray, np.ndarray], np.ndarray]


def measured() -> tuple[list[tuple[str, float, float]], tuple[float, float]]:
    """(form, all rows, held out) of the forms fitted here, and the same two figures of the diagnosis [Nm]."""
    table = read_table(data_folder() / LOG)
    robot = robot_for(table)
    log, motion, _ = ready(table, robot)
    samples = take(log, robot, motion, as_given(robot.joint_count))
    qd, y, full = samples.state.qd[:, 0], samples.y[:, 0], columns(samples.state, rotor=True)
    forms: dict[str, Left] = {
        "constant and viscous friction": lambda on, at: y[at] - _line(qd, y, on, at),
        "constant and viscous friction, no offset": lambda on, at: y[at] - _line(qd, y, on, at, 0.0),
        "Stribeck friction": lambda on, at: y[at] - _stribeck(qd[at], _fitted(qd[on], y[on])),
        "base inertial parameters, viscous and dry friction, rotor": lambda on, at: (
            samples.y[at] - full[at] @ fit(full[on], samples.y[on])
        )[:, 0],
    }
    folds, rows = time_folds(len(y)), np.arange(len(y))
    out = []
    for form, left in forms.items():
        held = np.concatenate([left(rows[folds != k], rows[folds == k]) for k in np.unique(folds)])
        out.append((form, _rms(left(rows, rows)), _rms(held)))
    after = diagnose(table, robot).after
    return out, (after.fit_rms, after.heldout_rms or float("nan"))


def _line(qd: np.ndarray, y: np.ndarray, on: np.ndarray, at: np.ndarray, offset: float = 1.0) -> np.ndarray:
    X = np.column_stack([np.sign(qd), qd, np.full_like(qd, offset)])
    return X[at] @ np.linalg.lstsq(X[on], y[on], rcond=None)[0]


def _stribeck(qd: np.ndarray, p: np.ndarray) -> np.ndarray:
    dry, viscous, more, speed, offset = p
    return (dry + more * np.exp(-((qd / speed) ** 2))) * np.sign(qd) + viscous * qd + offset


def _fitted(qd: np.ndarray, y: np.ndarray) -> np.ndarray:
    return least_squares(lambda p: _stribeck(qd, p) - y, _START, bounds=(_LEAST, _MOST)).x


def _rms(left: np.ndarray) -> float:
    return float(np.sqrt(np.mean(left**2)))


def run() -> list[Row]:
    """The diagnosis beside the best form fitted here, held out."""
    forms, (_, ours) = measured()
    return [
        Row(
            "torque error of one joint, held out", ours, min(form[2] for form in forms), "least squares", "Nm"
        )
    ]


def section() -> str:
    """The document's section."""
    forms, (fitted, held) = measured()
    here = {form: (f"{every:.3f}", f"{out:.3f}") for form, every, out in forms}
    names = [*PUBLISHED, *(form for form in here if form not in PUBLISHED)]
    rows = [
        (name, f"{PUBLISHED[name]:.3f}" if name in PUBLISHED else "-", *here.get(name, ("-", "-")))
        for name in names
    ]
    rows.append(("program", "-", f"{fitted:.3f}", f"{held:.3f}"))
    head = (
        "## One joint beside networks\n\nTorque error [Nm rms] of `panda_joint_motion/run_a.csv`, by `python -m "
        "benchmarks joint_friction --write`: as its source publishes it\n(over all rows, which were learnt from), "
        "the same forms fitted here to every fifth of its rows, and held out by stretches of time.\nHow the "
        "source fitted its forms, and whether they have an offset, is not said there: half of the torque is one.\n\n"
    )
    return head + markdown(("form", "published", "fitted here, all rows", "fitted here, held out"), rows)


def command(words: list[str]) -> int:
    """Prints the section; `--write` puts it into the document."""
    text = section()
    print(text)
    if "--write" in words:
        replace_section(DOCS / "real_recordings.md", "friction", text)
    return 0


if __name__ == "__main__":
    sys.exit(command(sys.argv[1:]))
