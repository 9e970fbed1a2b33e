"""Are these torques of this arm? Motor currents recorded where torques are expected are told by their size."""

from __future__ import annotations

import numpy as np

from app.errors import UnitError
from app.kinematics import RobotModel
from app.recordings.table import Table

#: Measured torques below this share of the description's gravity, on every joint that feels it, are something else. A
#: description's masses may be wrong by a half; drives give 5 to 200 Nm at the joint for an ampere.
_SMALL, _SMALLEST = 0.2, 0.005
_ALIKE = 0.9  # correlation with gravity that says it is this arm that moves, in these angles
_MOST_ROWS = 500
_LEAST_ROWS = 60


def check_torques(table: Table, robot: RobotModel) -> None:
    """Raises where the recorded torques follow the description's gravity and are far smaller.

    Raises:
        UnitError: they look like motor currents; says how to state that.
    """
    names = [f"tau{j}" for j in range(1, robot.joint_count + 1)]
    angles = [f"q{j}" for j in range(1, robot.joint_count + 1)]
    if not robot.has_inertials or robot.followers or not table.has(*names, *angles):
        return
    step = max(1, len(table) // _MOST_ROWS)
    q = np.stack([table.tolerant(name)[::step] for name in angles], axis=1)
    measured = np.stack([table.tolerant(name)[::step] for name in names], axis=1)
    good = np.isfinite(np.column_stack([q, measured])).all(axis=1)
    q, measured = q[good], measured[good]
    if len(q) < _LEAST_ROWS:
        return
    expected = robot.gravity_torques(q)
    size = np.sqrt(np.mean(expected**2, axis=0))
    feels = size > 0.1 * size.max()
    if not size.max() > 0:
        return
    products = np.sum(measured * expected, axis=0)[feels]
    shares = products / np.sum(expected**2, axis=0)[feels]
    alike = products / np.sqrt(np.sum(expected**2, axis=0) * np.sum(measured**2, axis=0) + 1e-300)[feels]
    strongest = int(np.argmax(size[feels]))
    if np.all(shares < _SMALL) and shares[strongest] > _SMALLEST and alike[strongest] > _ALIKE:
        raise UnitError(
            f"the torques are about 1/{1.0 / shares[strongest]:.0f} of the description's: motor currents?",
            file=table.path,
            row=table.header_row,
            column=table.columns[names[int(np.flatnonzero(feels)[strongest])]].name,
            expected="columns i1_A… with '# drive_gain_Nm_per_A: [..]', or --effort A --drive-gain …; "
            "--effort Nm takes them as they are",
        )
