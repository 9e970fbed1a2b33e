"""A serial arm as plain arrays: every pose of a recording in one sweep, without a loop over poses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.geometry.rotation import skew


@dataclass(frozen=True, eq=False)
class Frames:
    """Where every joint and the flange are, for m poses, in the base frame.

    Args:
        joint_rotations: (m, n, 3, 3) of the frame of joint j before it moves.
        joint_positions: (m, n, 3) [m], on the axis of joint j.
        axes: (m, n, 3) unit direction of each joint.
        flange_rotations: (m, 3, 3).
        flange_positions: (m, 3) [m].
        follower_positions: (m, f, 3) [m], on the axis of each joint that follows another.
        follower_axes: (m, f, 3) unit direction of each.
    """

    joint_rotations: np.ndarray
    joint_positions: np.ndarray
    axes: np.ndarray
    flange_rotations: np.ndarray
    flange_positions: np.ndarray
    follower_positions: np.ndarray
    follower_axes: np.ndarray


@dataclass(frozen=True, eq=False)
class Following:
    """A joint between two others that follows one of the chain's (URDF's `<mimic>`): q = multiplier q_master + offset.

    Args:
        before: the joint (or, if n, the flange) in front of whose own placement it stands.
        rotation: (3, 3) of its frame in its parent's.
        translation: (3,) [m] likewise.
        axis: (3,) unit, in its own frame.
        prismatic: True where it slides.
        master: index of the joint it follows.
        multiplier: of the master's position.
        offset: [rad or m].
    """

    before: int
    rotation: np.ndarray
    translation: np.ndarray
    axis: np.ndarray
    prismatic: bool
    master: int
    multiplier: float
    offset: float


@dataclass(frozen=True, eq=False)
class Step:
    """One moving joint on the way from base to flange, for whoever walks along it.

    Args:
        body: number of what it moves: 1 to n for the chain's joints, then its followers.
        rotation: (3, 3) of its frame on the body before.
        translation: (3,) [m] likewise.
        axis: (3,) unit.
        prismatic: True where it slides.
        source: index of the joint whose position it takes,
        multiplier: times this,
        offset: and this added [rad or m].
    """

    body: int
    rotation: np.ndarray
    translation: np.ndarray
    axis: np.ndarray
    prismatic: bool
    source: int
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, eq=False)
class Chain:
    """n joints, base to flange.

    Args:
        rotations: (n, 3, 3) of the joint's frame in its parent's.
        translations: (n, 3) [m] likewise.
        axes: (n, 3) unit, in the joint's own frame.
        prismatic: (n,) True where the joint slides.
        flange_rotation: (3, 3) of the flange in the last link.
        flange_translation: (3,) [m] likewise.
        masses: (n,) [kg] of what moves with joint j; fixed attachments are merged in.
        coms: (n, 3) [m] its centre of mass, in the frame of joint j after it moved.
        inertias: (n, 3, 3) [kg m^2] about that centre.
        followers: joints that follow one of the n, base to flange.
    """

    rotations: np.ndarray
    translations: np.ndarray
    axes: np.ndarray
    prismatic: np.ndarray
    flange_rotation: np.ndarray
    flange_translation: np.ndarray
    masses: np.ndarray
    coms: np.ndarray
    inertias: np.ndarray
    followers: tuple[Following, ...] = ()

    def __post_init__(self):
        for name in self.__dataclass_fields__.keys() - {"followers"}:
            array = np.array(getattr(self, name))
            array.flags.writeable = False
            object.__setattr__(self, name, array)

    @property
    def joint_count(self) -> int:
        return len(self.axes)

    @property
    def steps(self) -> tuple[Step, ...]:
        """Every moving joint from base to flange, followers among them."""
        found: list[Step] = []
        for j in range(self.joint_count + 1):
            for k, f in enumerate(self.followers):
                if f.before == j:
                    body = self.joint_count + 1 + k
                    found.append(
                        Step(
                            body,
                            f.rotation,
                            f.translation,
                            f.axis,
                            f.prismatic,
                            f.master,
                            f.multiplier,
                            f.offset,
                        )
                    )
            if j < self.joint_count:
                slides = bool(self.prismatic[j])
                found.append(Step(j + 1, self.rotations[j], self.translations[j], self.axes[j], slides, j))
        return tuple(found)

    def frames(
        self, q: np.ndarray, shifts: np.ndarray | None = None, turns: np.ndarray | None = None
    ) -> Frames:
        """Forward kinematics of m poses.

        Args:
            q: (m, n) [rad or m].
            shifts: (n+1, 3) or (m, n+1, 3) [m], displacement of the placement of joint j (the last: of the
                flange), expressed in the joint's own frame: P -> P @ Trans(shift) @ Rot(turn).
            turns: the same shapes, rotation matrices (..., n+1, 3, 3).

        Returns:
            Frames.
        """
        q = np.atleast_2d(np.asarray(q, float))
        m, n = q.shape
        rotation = np.tile(np.eye(3), (m, 1, 1))
        position = np.zeros((m, 3))
        joint_rotations, joint_positions = np.empty((m, n, 3, 3)), np.empty((m, n, 3))
        axes = np.empty((m, n, 3))
        followed = np.empty((2, m, len(self.followers), 3))  # positions, axes
        for j in range(n + 1):
            last = j == n
            for k, follower in enumerate(self.followers):
                if follower.before == j:
                    position = position + _times(rotation, follower.translation)
                    rotation = _times(rotation, follower.rotation)
                    followed[:, :, k] = position, _times(rotation, follower.axis)
                    moved = follower.multiplier * q[:, follower.master] + follower.offset
                    if follower.prismatic:
                        position = position + followed[1, :, k] * moved[:, None]
                    else:
                        rotation = _turned(rotation, follower.axis, np.cos(moved), np.sin(moved))
            placement_r = self.flange_rotation if last else self.rotations[j]
            placement_p = self.flange_translation if last else self.translations[j]
            if shifts is not None and shifts.ndim == 2:  # the same in every pose
                placement_p, shift = placement_p + placement_r @ shifts[j], None
            else:
                shift = None if shifts is None else shifts[:, j, :, None]
            turn = None if turns is None else turns[..., j, :, :]
            if turn is not None and turn.ndim == 2 and shift is None:
                placement_r, turn = placement_r @ turn, None
            position = position + _times(rotation, placement_p)
            rotation = _times(rotation, placement_r)
            if shift is not None:
                position = position + (rotation @ shift)[..., 0]
            if turn is not None:
                rotation = rotation @ turn
            if last:
                break
            joint_rotations[:, j], joint_positions[:, j] = rotation, position
            axis = self.axes[j]
            axes[:, j] = _times(rotation, axis)
            if self.prismatic[j]:
                position = position + axes[:, j] * q[:, j, None]
            else:
                rotation = _turned(rotation, axis, np.cos(q[:, j]), np.sin(q[:, j]))
        return Frames(joint_rotations, joint_positions, axes, rotation, position, followed[0], followed[1])

    def jacobian_columns(self, frames: Frames, points: np.ndarray) -> np.ndarray:
        """d point / d q_j for points carried by the flange.

        Args:
            points: (m, 3) [m] in base.

        Returns:
            (m, 3, n), metres per radian (or per metre for a sliding joint).
        """
        arm = points[:, None, :] - frames.joint_positions  # (m, n, 3)
        turning = np.cross(frames.axes, arm)
        columns = np.where(self.prismatic[None, :, None], frames.axes, turning)
        for k, follower in enumerate(self.followers):
            axis, place = frames.follower_axes[:, k], frames.follower_positions[:, k]
            own = axis if follower.prismatic else np.cross(axis, points - place)
            columns[:, follower.master] += follower.multiplier * own
        return np.swapaxes(columns, 1, 2)


def _turned(rotation: np.ndarray, axis: np.ndarray, cosine: np.ndarray, sine: np.ndarray) -> np.ndarray:
    """(m, 3, 3) R exp(q [axis]x) for (m,) angles."""
    k = int(np.argmax(np.abs(axis)))
    if abs(axis[k]) == 1.0:  # the columns across the axis turn into each other
        c, s = cosine[:, None], (axis[k] * sine)[:, None]
        a, b = rotation[:, :, (k + 1) % 3], rotation[:, :, (k + 2) % 3]
        out = rotation.copy()
        out[:, :, (k + 1) % 3] = c * a + s * b
        out[:, :, (k + 2) % 3] = c * b - s * a
        return out
    once = _times(rotation, skew(axis))  # Rodrigues' formula multiplied out
    twice = _times(once, skew(axis))
    return rotation + sine[:, None, None] * once + (1.0 - cosine)[:, None, None] * twice


def _times(matrices: np.ndarray, fixed: np.ndarray) -> np.ndarray:
    """(m, 3, 3) times one fixed (3, 3) or (3,), as one tall product: numpy's stacked one is far slower."""
    return (matrices.reshape(-1, 3) @ fixed).reshape(len(matrices), *((3,) * fixed.ndim))
