"""What pictures of a diagnosed log are drawn from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.model import ModelEffect
from app.diagnosis.models.dynamic.hypothesis import as_given
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.result import UNNAMED, Evidence

if TYPE_CHECKING:
    from app.diagnosis.dynamic.fitting import Fitted
    from app.diagnosis.models.dynamic.saved import Predicted


def evidence_of(
    fitted: Fitted, before: np.ndarray, whole: Predicted, effects: tuple[ModelEffect, ...]
) -> Evidence:
    state, n = fitted.study.state, fitted.robot.joint_count
    drivers = {"time [s]": state.t}
    for j in range(n):
        drivers[f"q{j + 1} [rad]"] = state.q[:, j]
        drivers[f"qd{j + 1} [rad/s]"] = state.qd[:, j]
        drivers[f"qdd{j + 1} [rad/s^2]"] = state.qdd[:, j]
        drivers[f"gravity torque {j + 1} [Nm]"] = state.gravity_torque[:, j]
        if state.temperature is not None:
            drivers[f"temperature {j + 1} [degC]"] = state.temperature[:, j]
    parts: dict[str, np.ndarray] = {}
    for k, added in whole.parts:
        family = laws()[effects[k].effect].family
        parts[family] = parts.get(family, np.zeros_like(before)) + state.hypothesis.recorded(added)
    explained = before - whole.residual - sum(parts.values(), np.zeros_like(before))
    if np.abs(explained).max() > 1e-9:  # how the log is read: mounting, factors, delay, conventions
        read = [laws()[e.effect].family for e in effects if laws()[e.effect].undone]
        first = read[0] if read else UNNAMED
        parts[first] = parts.get(first, np.zeros_like(before)) + explained
    centre = fitted.study.samples.centre
    return Evidence(
        rows=fitted.log.rows[centre], measured=before + described(fitted), before=before, after=whole.residual,
        components=tuple(f"joint {j + 1}" for j in range(n)), unit="Nm", q=state.q, drivers=drivers,
        kept=np.asarray(fitted.study.samples.used.all(axis=1)), t=state.t, parts=parts,
    )  # fmt: skip


def described(fitted: Fitted) -> np.ndarray:
    return fitted.take(as_given(fitted.robot.joint_count)).description
