"""What every row's errors can follow: the drivers. Computed from what was recorded, never from the residual."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from app.diagnosis.models.kinematic.geometry import LinkAxes, link_axes
from app.diagnosis.models.kinematic.gravity import (
    gravity_torques,
    leaning_torques,
    lumped_masses,
    moment_torques,
    payload_torques,
)
from app.kinematics import Chain, RobotModel

MOVED = 1e-7  # rad or m: a joint that changed by less than this has rested
ROUNDING = 1e-12  # of the largest torque: what is smaller is none


@dataclass(frozen=True, eq=False)
class Situation:
    """The rows as the effects see them.

    Args:
        chain: the nominal arm.
        links: directions of its geometry.
        q: (m, n) what the controller shows [rad or m].
        torque: (m, n) torque (force) that holds each joint [Nm or N].
        torque_source: "measured", "description" or "assumed".
        leaning: (m, n, 2) [Nm/rad] torque by a lean of the base about its x and y; None where it was measured.
        moment: (m, n, 4) torque by an unlisted payload of unit mass and unit first moments.
        declared_compliance: (n,) [rad/Nm] from the recording's header, or None.
        approach: (m, n) sign of each joint's last move; 0 before the first.
        move: (m, n) the change since the row before [rad or m].
        speed: (m, n) of each joint, where the recording was made in motion; else zeros [rad/s or m/s].
        time: (m,) since the first row [s], or the row's number where no time was recorded.
        time_unit: "s" or "row".
        temperature: (m,) above the first row's [K], or None.
        order: (m,) 1-based number of the row among the data rows, before any was set aside.
        payload: (m,) known mass at the flange [kg], or None; payload_com (3,) its centre [m].
        instrument: what is measured: "points", "targets" (touches of unknown points) or "length" (a draw-wire).
        reflectors: points that are measured in each pose.
    """

    chain: Chain
    links: LinkAxes
    q: np.ndarray
    torque: np.ndarray
    torque_source: str
    leaning: np.ndarray | None
    moment: np.ndarray
    declared_compliance: np.ndarray | None
    approach: np.ndarray
    move: np.ndarray
    speed: np.ndarray
    time: np.ndarray
    time_unit: str
    temperature: np.ndarray | None
    order: np.ndarray
    payload: np.ndarray | None = None
    payload_com: np.ndarray | None = None
    instrument: str = "points"
    reflectors: int = 1

    @cached_property
    def kept(self) -> dict[tuple, Any]:
        """What effects have worked out of these drivers once, by a key of their own."""
        return {}

    @property
    def joint_count(self) -> int:
        return self.chain.joint_count

    def after(self, row: int) -> np.ndarray:
        """(m,) 1.0 from data row `row` (1-based) on, else 0.0."""
        return (self.order >= row).astype(float)


def approach_signs(q: np.ndarray, sessions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sign of every joint's last move and the move itself; a joint that rests keeps its sign.

    Args:
        q: (m, n) in the order of the recording.
        sessions: (m,) number of the session; a new session starts unknown.

    Returns:
        signs (m, n) of -1, 0, 1 and moves (m, n).
    """
    move = np.zeros_like(q)
    move[1:] = np.diff(q, axis=0)
    fresh = np.ones(len(q), bool)
    fresh[1:] = sessions[1:] != sessions[:-1]
    move[fresh] = 0.0
    sign = np.where(np.abs(move) > MOVED, np.sign(move), 0.0)
    rows = np.arange(len(q))[:, None]
    last = np.maximum.accumulate(np.where((sign != 0) | fresh[:, None], rows, 0), axis=0)
    return np.take_along_axis(sign, last, axis=0), move


def situation_for(
    robot: RobotModel,
    q: np.ndarray,
    *,
    sessions: np.ndarray | None = None,
    torque: np.ndarray | None = None,
    payload: np.ndarray | None = None,
    payload_com: np.ndarray | None = None,
    declared_compliance: np.ndarray | None = None,
    time: np.ndarray | None = None,
    speed: np.ndarray | None = None,
    temperature: np.ndarray | None = None,
    order: np.ndarray | None = None,
    keep: np.ndarray | None = None,
    instrument: str = "points",
    reflectors: int = 1,
) -> Situation:
    """The drivers of rows `q`; measured torques win over computed ones.

    Args:
        q: (m, n) [rad or m].
        torque: (m, n) measured holding torques [Nm].
        payload: (m,) [kg] known mass at the flange.
        payload_com: (3,) [m] its centre in the flange.
        time: (m,) [s].
        speed: (m, n) of the joints, in a recording made in motion.
        temperature: (m,) [degC].
        keep: (m,) True for the rows that are worked on, all without it; moves and times are seen among all rows, and of
            very many nothing else is worked out.
    """
    chain = robot.chain
    m = len(q)
    approach, move = approach_signs(q, np.zeros(m, int) if sessions is None else sessions)
    order = np.arange(1, m + 1) if order is None else order
    unit = "row" if time is None else "s"
    since = np.arange(m, dtype=float) if time is None else time - time[0]
    temperature = None if temperature is None else temperature - temperature[0]
    speed = np.zeros(q.shape) if speed is None else speed
    if keep is not None:
        q, approach, move = q[keep], approach[keep], move[keep]
        order, since, speed = order[keep], since[keep], speed[keep]
        torque, payload, temperature = (
            None if x is None else x[keep] for x in (torque, payload, temperature)
        )
    frames = chain.frames(q)
    leaning = None
    source = "measured"  # in holding sign already, see sensed.py
    if torque is None:
        source = "description" if robot.has_inertials else "assumed"
        masses, coms = (chain.masses, chain.coms) if robot.has_inertials else lumped_masses(chain)
        torque = gravity_torques(chain, frames, masses, coms)
        leaning = leaning_torques(chain, frames, masses, coms)
        if payload is not None:
            com = np.zeros(3) if payload_com is None else payload_com
            torque = torque + payload_torques(chain, frames, payload, com)
        # An upright joint carries nothing: what rounding leaves of it has a sign at random, and no backlash follows.
        torque = np.where(np.abs(torque) > ROUNDING * np.abs(torque).max(initial=0.0), torque, 0.0)
    return Situation(
        chain=chain,
        links=link_axes(chain),
        q=q,
        torque=torque,
        torque_source=source,
        leaning=leaning,
        moment=moment_torques(chain, frames),
        declared_compliance=declared_compliance,
        approach=approach,
        move=move,
        speed=speed,
        time=since,
        time_unit=unit,
        temperature=temperature,
        order=order,
        payload=payload,
        payload_com=payload_com,
        instrument=instrument,
        reflectors=reflectors,
    )
