"""Forward kinematics of a serial arm whose geometry deviates from its description, for many poses at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin  # pyright: ignore[reportMissingImports]  (found through a .pth hook)
from scipy.spatial.transform import Rotation

from app.kinematics import RobotModel


@dataclass(frozen=True, eq=False)
class Deviation:
    """How an arm deviates from its description.

    Args:
        zeros: (n,) added to each joint's angle [rad or m].
        shifts: (n, 3) each joint's place moved, in the frame of the link before it [m].
        turns: (n, 3) each joint's frame turned, in the frame of the link before it [rad].
        compliance: (n,) yield of each joint under its torque [rad/Nm].
    """

    zeros: np.ndarray
    shifts: np.ndarray
    turns: np.ndarray
    compliance: np.ndarray

    @classmethod
    def none(cls, n: int) -> Deviation:
        return cls(np.zeros(n), np.zeros((n, 3)), np.zeros((n, 3)), np.zeros(n))

    @property
    def flat(self) -> np.ndarray:
        """(8 n,) all values: zeros, shifts, turns, compliance."""
        return np.concatenate([self.zeros, self.shifts.ravel(), self.turns.ravel(), self.compliance])

    @classmethod
    def of(cls, values: np.ndarray) -> Deviation:
        """From `flat`."""
        n = len(values) // 8
        zeros, shifts, turns, compliance = np.split(values, [n, 4 * n, 7 * n])
        return cls(zeros, shifts.reshape(n, 3), turns.reshape(n, 3), compliance)


class Chain:
    """The arm as its description has it."""

    def __init__(self, robot: RobotModel):
        model = robot.model
        self.n = robot.joint_count
        placed = [model.jointPlacements[k + 1] for k in range(self.n)]
        self.turns = np.array([p.rotation for p in placed])
        self.offsets = np.array([p.translation for p in placed])
        self.sliding = np.array([joint.prismatic for joint in robot.joints])
        self.axes = np.zeros((self.n, 3))
        data = model.createData()
        pin.computeJointJacobians(model, data, pin.neutral(model))
        for k in range(self.n):
            column = pin.getJointJacobian(model, data, k + 1, pin.LOCAL).reshape(6, -1)[:, k]
            self.axes[k] = column[:3] if self.sliding[k] else column[3:]

    def points(
        self, q: np.ndarray, tools: np.ndarray, deviation: Deviation, torque: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Points of the last link in the base frame, and how they move with each deviation.

        Args:
            q: (m, n) joint positions [rad or m].
            tools: (m, P, 3) points in the last joint's frame [m].
            torque: (m, n) torque of each joint [Nm].

        Returns:
            points (m, P, 3) [m]; derivative (m, P, 3, 8 n) in the order of `Deviation.flat`; (m, 3, 3) rotation of
            the last joint's frame.
        """
        m, n = q.shape
        moved = q + deviation.zeros + deviation.compliance * torque
        rotation, place = np.broadcast_to(np.eye(3), (m, 3, 3)), np.zeros((m, 3))
        before, joints, axes = [], [], []
        for k in range(n):
            before.append(rotation)
            place = place + rotation @ (self.offsets[k] + deviation.shifts[k])
            turn = Rotation.from_rotvec(deviation.turns[k]).as_matrix() @ self.turns[k]
            rotation = rotation @ turn
            axes.append(rotation @ self.axes[k])
            joints.append(place)
            if self.sliding[k]:
                place = place + axes[k] * moved[:, k, None]
            else:
                rotation = rotation @ Rotation.from_rotvec(moved[:, k, None] * self.axes[k]).as_matrix()
        points = place[:, None] + tools @ rotation.swapaxes(1, 2)
        derivative = np.zeros((*points.shape, 8 * n))
        for k in range(n):
            arm = points - joints[k][:, None]
            along = axes[k][:, None]
            derivative[..., k] = (
                np.broadcast_to(along, arm.shape) if self.sliding[k] else np.cross(along, arm)
            )
            for a in range(3):
                direction = before[k][:, None, :, a]
                derivative[..., n + 3 * k + a] = np.broadcast_to(direction, arm.shape)
                derivative[..., 4 * n + 3 * k + a] = np.cross(direction, arm)
            derivative[..., 7 * n + k] = derivative[..., k] * torque[:, k, None, None]
        return points, derivative, rotation
