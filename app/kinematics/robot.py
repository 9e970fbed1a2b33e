"""One arm: forward kinematics, Jacobian, gravity torques and limits, computed by pin."""

from __future__ import annotations

import threading
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin  # pyright: ignore[reportMissingImports]  (found through a .pth hook)

from app.geometry.pose import Pose
from app.kinematics.chain import Chain, Following

#: Names of files that do not tell one arm from another, in small letters.
_SAYS_NOTHING = {"robot", "model", "urdf", "description"}
GRAVITY = np.array([0.0, 0.0, -9.81])  # m/s^2 in base, pin's default


@dataclass(frozen=True)
class Joint:
    """One moving joint; limits in rad or m, rad/s or m/s, Nm or N."""

    name: str
    prismatic: bool
    lower: float
    upper: float
    velocity: float
    effort: float


@dataclass(frozen=True)
class Follower:
    """A joint inside the arm that follows another: position = multiplier * position of the master + offset.

    Args:
        name: its own.
        prismatic: True where it slides.
        master: index of the joint it follows.
        multiplier: of the master's position.
        offset: [rad or m].
    """

    name: str
    prismatic: bool
    master: int
    multiplier: float
    offset: float


@dataclass(frozen=True, eq=False)
class RobotModel:
    """A serial arm of one joint or more.

    Args:
        name: catalogue name, or the file's stem.
        path: the file it was read from.
        joints: in the description's order; users count them from 1.
        model: pin's model.
        flange: name of the link tools are bolted to.
        description: robot.toml of a shipped robot; empty for a bare URDF.
        base: name of the link whose frame poses are in.
        address: what loads this very arm again: file, and what was chosen in it.
        urdf: the arm alone as a small URDF, see description/plain.py.
        followers: joints inside the arm that follow one of `joints`, base to flange.
        source: the whole description, for what is drawn.
        kept: what was worked out of it once and is too large to work out again, by the name of who did.
    """

    name: str
    path: Path
    joints: tuple[Joint, ...]
    model: pin.Model
    flange: str
    description: dict[str, Any]
    base: str = ""
    address: str = ""
    urdf: str = field(default="", repr=False)
    followers: tuple[Follower, ...] = ()
    source: ET.Element | None = field(default=None, repr=False)
    kept: dict[str, Any] = field(default_factory=dict, repr=False)
    _local: threading.local = field(default_factory=threading.local, repr=False)

    def __getstate__(self) -> dict[str, Any]:
        """For another process: without what is worked out again there."""
        return {**self.__dict__, "kept": {}, "_local": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update({**state, "_local": threading.local()})

    @property
    def title(self) -> str:
        """The description's, else the file's name; where that says nothing, what the file calls its robot."""
        inside = self.source.get("name") if self.source is not None else None
        own = inside if inside and self.name.lower() in _SAYS_NOTHING else self.name
        return self.description.get("title", own)

    def said(self, key: str, language: str) -> str:
        """What the description says under a key, `title` or `maker`, in a language: its table `words.LANGUAGE` first.

        Names stay themselves in every language; only what is no name needs another word.
        """
        own = self.title if key == "title" else str(self.description.get(key, "?"))
        return str(self.description.get("words", {}).get(language, {}).get(key, own))

    @property
    def joint_count(self) -> int:
        return len(self.joints)

    @cached_property
    def lower(self) -> np.ndarray:
        """(n,) lower joint limits [rad or m]."""
        return np.array([j.lower for j in self.joints])

    @cached_property
    def upper(self) -> np.ndarray:
        """(n,) upper joint limits [rad or m]."""
        return np.array([j.upper for j in self.joints])

    @cached_property
    def velocity(self) -> np.ndarray:
        """(n,) joint speed limits [rad/s or m/s]; 0 where the description states none."""
        return np.array([j.velocity for j in self.joints])

    @cached_property
    def home(self) -> np.ndarray:
        """(n,) a comfortable pose: the description's, else zero brought inside the limits."""
        q = self.description.get("home_rad")
        return (
            np.array(q, float)
            if q is not None
            else np.clip(np.zeros(len(self.joints)), self.lower, self.upper)
        )

    @cached_property
    def has_inertials(self) -> bool:
        """True where the description states masses."""
        return bool(np.any(self.chain.masses > 0))

    @cached_property
    def flange_id(self) -> int:
        return self.model.getFrameId(self.flange, pin.FrameType.BODY)  # joints may bear the same name

    @property
    def data(self) -> pin.Data:
        """pin's workspace; one a thread, because pin writes into it."""
        if not hasattr(self._local, "data"):
            self._local.data = self.model.createData()
        return self._local.data

    def flange_matrix(self, q: np.ndarray) -> np.ndarray:
        """T_base_flange as a plain (4, 4) array, the quickest way to it; q (n,) [rad or m]."""
        data = self.data
        pin.framesForwardKinematics(self.model, data, q)
        return data.oMf[self.flange_id].homogeneous

    def forward(self, q: np.ndarray) -> Pose:
        """T_base_flange; q (n,) [rad or m]."""
        return Pose(self.flange_matrix(np.asarray(q, float)))

    def jacobian(self, q: np.ndarray) -> np.ndarray:
        """(6, n) of the flange's origin, axes of base: rows 0-2 m/rad, rows 3-5 rad/rad; q (n,)."""
        jacobian = pin.computeFrameJacobian(
            self.model, self.data, np.asarray(q, float), self.flange_id, pin.LOCAL_WORLD_ALIGNED
        )
        return jacobian.reshape(6, -1)  # of a single joint pin gives a plain vector

    def gravity_torques(self, q: np.ndarray) -> np.ndarray:
        """Torque each joint must give to hold the arm; (m, n) or (n,) -> the same shape [Nm or N]."""
        q = np.asarray(q, float)
        if q.ndim == 1:
            return pin.computeGeneralizedGravity(self.model, self.data, q).copy()
        return np.array([pin.computeGeneralizedGravity(self.model, self.data, row) for row in q])

    def within_limits(self, q: np.ndarray, margin: float = 0.0) -> np.ndarray:
        """True where every joint is inside its limits by `margin`; (..., n) -> (...)."""
        return np.all((q >= self.lower + margin) & (q <= self.upper - margin), axis=-1)

    @cached_property
    def reach(self) -> float:
        """Largest distance of the flange from the axis of joint 1 [m]; limits are respected."""
        return self._farthest(level=True)

    @cached_property
    def radius(self) -> float:
        """Largest distance of the flange from the origin of joint 1 [m]; limits are respected."""
        return self._farthest(level=False)

    def _farthest(self, *, level: bool) -> float:
        """Found by search, not by adding lengths: random poses, then a climb from the best few."""
        rng = np.random.default_rng(0)
        low, high = np.clip(self.lower, -np.pi, np.pi), np.clip(self.upper, -np.pi, np.pi)
        frames = self.chain.frames(low[None])
        origin, axis = frames.joint_positions[0, 0], frames.axes[0, 0]

        def distance(q: np.ndarray) -> np.ndarray:
            p = self.chain.frames(q).flange_positions - origin
            return np.linalg.norm(p - (p @ axis)[:, None] * axis if level else p, axis=1)

        samples = rng.uniform(low, high, (2000, self.joint_count))
        values, best = distance(samples), 0.0
        for q in samples[np.argsort(values)[-5:]]:
            step, value = 0.3, float(distance(q[None])[0])
            while step > 1e-4:
                trials = np.clip(q + rng.normal(0, step, (64, len(q))), low, high)
                found = distance(trials)
                if found.max() > value:
                    q, value = trials[np.argmax(found)], float(found.max())
                else:
                    step *= 0.5
            best = max(best, value)
        return best

    @cached_property
    def chain(self) -> Chain:
        """The arm as plain arrays, for many poses at once."""
        n, model = self.joint_count, self.model
        ids = [model.getJointId(j.name) for j in self.joints]
        placements = [model.jointPlacements[i] for i in ids]
        flange = model.frames[self.flange_id].placement
        inertias = [model.inertias[i] for i in ids]
        axes = np.empty((n, 3))
        zero = pin.neutral(model)
        data = model.createData()
        pin.computeJointJacobians(model, data, zero)
        for k, i in enumerate(ids):
            column = pin.getJointJacobian(model, data, i, pin.LOCAL).reshape(6, -1)[:, model.joints[i].idx_v]
            axes[k] = column[:3] if self.joints[k].prismatic else column[3:]
        return Chain(
            rotations=np.array([p.rotation for p in placements]),
            translations=np.array([p.translation for p in placements]),
            axes=axes,
            prismatic=np.array([j.prismatic for j in self.joints]),
            flange_rotation=flange.rotation,
            flange_translation=flange.translation,
            masses=np.array([i.mass for i in inertias]),
            coms=np.array([i.lever for i in inertias]),
            inertias=np.array([i.inertia for i in inertias]),
            followers=self._followings(),
        )

    def _followings(self) -> tuple[Following, ...]:
        """Where the followers stand in the chain."""
        if not self.followers:
            return ()
        elements = {e.get("name"): e for e in ET.fromstring(self.urdf).findall("joint")}
        order = list(self.model.names)[1:]
        own = [joint.name for joint in self.joints]
        found = []
        for follower in self.followers:
            place = self.model.jointPlacements[self.model.getJointId(follower.name)]
            stated = elements[follower.name].find("axis")
            assert stated is not None  # plain.py writes one for every moving joint
            axis = np.array(stated.get("xyz", "1 0 0").split(), float)
            found.append(
                Following(
                    before=sum(name in own for name in order[: order.index(follower.name)]),
                    rotation=place.rotation.copy(),
                    translation=place.translation.copy(),
                    axis=axis / np.linalg.norm(axis),
                    prismatic=follower.prismatic,
                    master=follower.master,
                    multiplier=follower.multiplier,
                    offset=follower.offset,
                )
            )
        return tuple(found)
