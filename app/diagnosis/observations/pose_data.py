"""A static recording, frozen: joint positions and what was measured at them."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Literal

import numpy as np

from app.diagnosis.models.kinematic.in_motion import speeds
from app.diagnosis.models.kinematic.situation import Situation, situation_for
from app.kinematics import RobotModel

Mode = Literal["points", "targets", "length"]


@dataclass(frozen=True, eq=False)
class StaticRecording:
    """Rows that can be used, in the order they were taken.

    Args:
        file: name for messages.
        kind: "touch" or "tracker".
        mode: "points": measured points (a touch of known targets too); "targets": touches of unknown points;
            "length": a draw-wire.
        rows: (m,) line number in the file.
        points: (m, r, 3) measured in the instrument's (fixture's) frame [m]; NaN where a reflector was lost.
        orientations: (m, 3, 3) measured, NaN where missing; None without that measurement.
        lengths: (m,) [m], or None.
        target: (m,) number of the touched target; zeros where nothing is touched.
        target_names: one a target.
        session: (m,) number of the session.
        pose: (m,) number of the pose; rows that repeat one share it.
        situation: the drivers.
        stated_noise: one-sigma a component [m], or None.
        angle_resolution: step of the recorded angles [rad]; 0 where they are written in full.
        length_resolution: step of the measured lengths [m].
        notes: warnings for a person.
        turn_worth: independent measurements that one measured angle of an orientation counts for, 0..1.
    """

    file: str
    kind: str
    mode: Mode
    rows: np.ndarray
    points: np.ndarray | None
    orientations: np.ndarray | None
    lengths: np.ndarray | None
    target: np.ndarray
    target_names: tuple[str, ...]
    session: np.ndarray
    pose: np.ndarray
    situation: Situation
    stated_noise: float | None
    angle_resolution: float
    length_resolution: float
    notes: tuple[str, ...] = ()
    turn_worth: float = 1.0

    @property
    def q(self) -> np.ndarray:
        return self.situation.q

    @property
    def size(self) -> int:
        return len(self.rows)

    @property
    def session_count(self) -> int:
        return int(self.session.max()) + 1 if self.size else 0

    @property
    def reflectors(self) -> int:
        return self.points.shape[1] if self.points is not None else 1

    @property
    def components(self) -> tuple[str, ...]:
        """Labels of what one row measures."""
        if self.mode == "length":
            return ("length",)
        if self.mode == "targets":
            return ("x", "y", "z")
        names = [f"{c}{'' if r == 0 else r + 1}" for r in range(self.reflectors) for c in "xyz"]
        if self.orientations is not None:
            names += ["turn x", "turn y", "turn z"]
        return tuple(names)

    @property
    def angular(self) -> np.ndarray:
        """(k,) True for the components that are angles [rad]."""
        return np.array([name.startswith("turn") for name in self.components])

    @property
    def worth(self) -> np.ndarray:
        """(k,) independent measurements that each component counts for."""
        return np.where(self.angular, self.turn_worth, 1.0)

    @property
    def present(self) -> np.ndarray:
        """(m, k) True where the component was measured."""
        m = self.size
        if self.mode == "targets":
            return np.ones((m, 3), bool)
        if self.mode == "length":
            assert self.lengths is not None
            return np.isfinite(self.lengths).reshape(m, 1)
        assert self.points is not None
        parts: list[np.ndarray] = [np.isfinite(self.points).reshape(m, -1)]
        if self.orientations is not None:
            seen = np.isfinite(self.orientations).all(axis=(1, 2))
            parts.append(np.repeat(np.reshape(seen, (m, 1)), 3, axis=1))
        return np.concatenate(parts, axis=1)

    def with_joints(self, robot: RobotModel, q: np.ndarray) -> StaticRecording:
        """The same measurements at other joint positions (m, n); drivers that follow from them are computed anew."""
        old = self.situation
        measured = old.torque if old.torque_source == "measured" else None
        new = situation_for(
            robot,
            q,
            sessions=self.session,
            torque=measured,
            payload=old.payload,
            payload_com=old.payload_com,
        )
        situation = replace(
            old,
            q=q,
            torque=new.torque,
            leaning=new.leaning,
            moment=new.moment,
            approach=new.approach,
            move=new.move,
            speed=speeds(old.time, q, self.session) if old.speed.any() else old.speed,
        )
        return replace(self, situation=situation)

    def by_points(self) -> StaticRecording:
        """The recording by its points alone, where it has any: what errors in mm are said of."""
        measured = self.orientations is not None and self.points is not None
        return replace(self, orientations=None) if measured else self

    def subset(self, keep: np.ndarray) -> StaticRecording:
        """The rows where `keep` (m,) is True; numbers of sessions, poses and targets stay what they were."""
        changed = {f.name: cut(getattr(self, f.name), keep) for f in fields(self) if f.name in _PER_ROW}
        names = [f.name for f in fields(Situation) if f.name in _PER_ROW_SITUATION]
        situation = replace(self.situation, **{n: cut(getattr(self.situation, n), keep) for n in names})
        return replace(self, situation=situation, **changed)


_PER_ROW = {"rows", "points", "orientations", "lengths", "target", "session", "pose"}
_PER_ROW_SITUATION = {
    "q", "torque", "leaning", "moment", "approach", "move", "speed", "time", "temperature", "order", "payload",
}  # fmt: skip


def cut(array: np.ndarray | None, keep: np.ndarray) -> np.ndarray | None:
    """Some rows of what may not be there."""
    return None if array is None else array[keep]
