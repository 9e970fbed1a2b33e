"""What pictures are drawn from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.kinematic.state import State
from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.result import Evidence
from app.units import deg

if TYPE_CHECKING:
    from app.diagnosis.kinematic.judging import Judgement


def evidence_of(recording: StaticRecording, judgement: Judgement) -> Evidence:
    """Measured and predicted of every row, outliers included."""
    before, after = judgement.before, judgement.after
    first = recording.session[0]
    measured_base = _measured_in_base(recording, after)
    if recording.mode == "length":
        measured = recording.lengths[:, None]  # type: ignore[index]
    elif recording.mode == "targets":
        measured = measured_base
    else:
        measured = recording.points.reshape(recording.size, -1)  # type: ignore[union-attr]
    seen = after.recording  # by its points alone where those were enough
    metric = ~seen.angular
    components = tuple(np.array(seen.components)[metric])
    return Evidence(
        rows=recording.rows,
        measured=np.nan_to_num(measured),
        before=before.residual[:, metric],
        after=after.residual[:, metric],
        components=components,
        unit="m",
        q=recording.q,
        drivers=drivers(recording),
        kept=judgement.kept,
        points_predicted_before=before.posed.points[:, 0],
        points_predicted_after=after.posed.points[:, 0],
        points_measured=measured_base,
        flange_tool=after.setup.tools[first, 0],
        vectors_before=_vectors(recording, before),
        vectors_after=_vectors(recording, after),
    )


def _vectors(recording: StaticRecording, fitted: State) -> np.ndarray:
    """(m, 3) residual of the first point (a wire's: along the wire), turned into base [m]."""
    setup = fitted.setup
    if recording.mode == "length":
        points = fitted.posed.points[:, 0] + setup.positions[recording.session]
        return points / np.linalg.norm(points, axis=1, keepdims=True) * fitted.residual[:, :1]
    rotation = setup.rotations[recording.session]
    return np.einsum("mji,mj->mi", rotation, fitted.residual[:, :3])


def _measured_in_base(recording: StaticRecording, fitted: State) -> np.ndarray:
    """First reflector (or target) brought into base, by the fitted setup."""
    setup = fitted.setup
    if recording.mode == "targets":
        return setup.targets[recording.target]
    rotation, position = setup.rotations[recording.session], setup.positions[recording.session]
    if recording.mode == "length":  # along the wire
        points = fitted.posed.points[:, 0] + position
        beam = points / np.linalg.norm(points, axis=1, keepdims=True)
        return fitted.posed.points[:, 0] + beam * fitted.residual[:, :1]
    assert recording.points is not None
    points = recording.points[:, 0]
    points = np.where(
        np.isfinite(points), points, position + np.einsum("mij,mj->mi", rotation, fitted.posed.points[:, 0])
    )
    return np.einsum("mji,mj->mi", rotation, points - position)


def drivers(recording: StaticRecording) -> dict[str, np.ndarray]:
    """What residuals can be plotted against."""
    situation = recording.situation
    out: dict[str, np.ndarray] = {}
    for j in range(situation.joint_count):
        sliding = situation.chain.prismatic[j]
        out[f"q{j + 1} [{'m' if sliding else 'deg'}]"] = (
            situation.q[:, j] if sliding else deg(situation.q[:, j])
        )
    for j in range(situation.joint_count):
        unit = "N" if situation.chain.prismatic[j] else "Nm"
        out[f"gravity torque {j + 1} [{unit}]"] = situation.torque[:, j]
        out[f"approach {j + 1} [-]"] = situation.approach[:, j]
    out[f"time [{situation.time_unit}]"] = situation.time
    if situation.temperature is not None:
        out["temperature [K]"] = situation.temperature
    return out
