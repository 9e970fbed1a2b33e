"""A pose: where a frame is, frozen.

`T_a_b` maps coordinates in b to coordinates in a, so names cancel from inside:
`T_base_tool = T_base_flange @ T_flange_tool`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.geometry.rotation import exp_so3, log_so3, quaternion_from_rotation, rotation_from_quaternion


@dataclass(frozen=True, eq=False)
class Pose:
    """A rigid transform. Positions in metres.

    Args:
        matrix: (4, 4) homogeneous, kept as a read-only copy.
    """

    matrix: np.ndarray

    def __post_init__(self):
        m = np.array(self.matrix, float)
        if m.shape != (4, 4):
            raise ValueError(f"a pose is (4, 4), not {m.shape}")
        m.flags.writeable = False
        object.__setattr__(self, "matrix", m)

    @classmethod
    def identity(cls) -> Pose:
        return cls(np.eye(4))

    @classmethod
    def of(cls, rotation: np.ndarray | None = None, position: np.ndarray | None = None) -> Pose:
        """From a rotation (3, 3) and a position (3,) [m]; either may be left out."""
        m = np.eye(4)
        if rotation is not None:
            m[:3, :3] = rotation
        if position is not None:
            m[:3, 3] = position
        return cls(m)

    @classmethod
    def from_quaternion(cls, wxyz: np.ndarray, position: np.ndarray) -> Pose:
        """From a quaternion (wxyz) and a position (3,) [m]."""
        return cls.of(rotation_from_quaternion(np.asarray(wxyz, float)), position)

    @classmethod
    def exp(cls, twist: np.ndarray) -> Pose:
        """A small displacement: (6,) = translation [m], then rotation vector [rad], applied separately."""
        twist = np.asarray(twist, float)
        return cls.of(exp_so3(twist[3:]), twist[:3])

    @property
    def rotation(self) -> np.ndarray:
        """(3, 3), read-only."""
        return self.matrix[:3, :3]

    @property
    def position(self) -> np.ndarray:
        """(3,) [m], read-only."""
        return self.matrix[:3, 3]

    @property
    def quaternion(self) -> np.ndarray:
        """(4,) wxyz with w >= 0."""
        return quaternion_from_rotation(self.rotation)

    @property
    def rotvec(self) -> np.ndarray:
        """(3,) [rad]."""
        return log_so3(self.rotation)

    def inverse(self) -> Pose:
        return Pose.of(self.rotation.T, -self.rotation.T @ self.position)

    def __matmul__(self, other: Pose) -> Pose:
        return Pose(self.matrix @ other.matrix)

    def apply(self, points: np.ndarray) -> np.ndarray:
        """Maps points (..., 3) [m]."""
        return points @ self.rotation.T + self.position

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Pose) and np.array_equal(self.matrix, other.matrix)

    def __hash__(self) -> int:
        return hash(self.matrix.tobytes())

    def __repr__(self) -> str:
        p = np.array2string(self.position, precision=6, suppress_small=True)
        r = np.array2string(self.rotvec, precision=6, suppress_small=True)
        return f"Pose(position={p} m, rotvec={r} rad)"
