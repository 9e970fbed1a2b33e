"""Torques that hold an arm against gravity, for every row at once."""

from __future__ import annotations

import numpy as np

from app.kinematics import Chain
from app.kinematics.chain import Frames
from app.kinematics.robot import GRAVITY

#: Assumed where a description states no masses: kilograms per metre of link, at the middle of each link.
LUMPED_KG_PER_M = 20.0


def gravity_torques(
    chain: Chain, frames: Frames, masses: np.ndarray, coms: np.ndarray, gravity: np.ndarray = GRAVITY
) -> np.ndarray:
    """Torque each joint must give to hold the links.

    Args:
        frames: of m poses.
        masses: (n,) [kg].
        coms: (n, 3) [m], in the frame of joint j after it moved.
        gravity: (3,) [m/s^2] in base.

    Returns:
        (m, n) [Nm, or N for a sliding joint].
    """
    m, n = frames.axes.shape[:2]
    torques = np.zeros((m, n))
    after_r, after_p = link_frames(chain, frames)
    first = np.zeros((m, 3))
    total = 0.0
    for j in range(n - 1, -1, -1):  # from the hand inwards: everything beyond joint j hangs on it
        centre = after_p[j] + after_r[j] @ coms[j]
        first = first + masses[j] * centre
        total = total + masses[j]
        torques[:, j] = _holding(chain, frames, j, first, total, gravity)
    return torques


def payload_torques(chain: Chain, frames: Frames, mass: np.ndarray, com: np.ndarray) -> np.ndarray:
    """Torque that an extra mass on the flange asks of each joint.

    Args:
        mass: (m,) [kg], one a row.
        com: (3,) [m] in the flange.

    Returns:
        (m, n) [Nm or N].
    """
    centre = frames.flange_positions + frames.flange_rotations @ com
    first = mass[:, None] * centre
    return np.stack(
        [_holding(chain, frames, j, first, mass[:, None]) for j in range(chain.joint_count)], axis=1
    )


def moment_torques(chain: Chain, frames: Frames) -> np.ndarray:
    """d torque / d (mass, first moments of the payload in the flange); (m, n, 4) [Nm/kg, Nm/(kg m)]."""
    m, n = frames.axes.shape[:2]
    out = np.empty((m, n, 4))
    for j in range(n):
        out[:, j, 0] = _holding(chain, frames, j, frames.flange_positions, 1.0)
        for c in range(3):
            out[:, j, 1 + c] = _holding(chain, frames, j, frames.flange_rotations[:, :, c], 0.0)
    return out


def link_frames(chain: Chain, frames: Frames) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Rotation (m, 3, 3) and origin (m, 3) of every link's frame after its joint moved."""
    n = chain.joint_count
    rotations, origins = [], []
    for j in range(n):
        if j + 1 < n:
            r = frames.joint_rotations[:, j + 1] @ chain.rotations[j + 1].T
            p = frames.joint_positions[:, j + 1] - r @ chain.translations[j + 1]
        else:
            r = frames.flange_rotations @ chain.flange_rotation.T
            p = frames.flange_positions - r @ chain.flange_translation
        rotations.append(r)
        origins.append(p)
    return rotations, origins


def lumped_masses(chain: Chain) -> tuple[np.ndarray, np.ndarray]:
    """Assumed masses and centres for a description that states none.

    Returns:
        masses (n,) [kg], coms (n, 3) [m].
    """
    vectors = np.vstack([chain.translations[1:], chain.flange_translation[None]])
    masses = LUMPED_KG_PER_M * np.linalg.norm(vectors, axis=1)
    return masses, 0.5 * vectors


def leaning_torques(chain: Chain, frames: Frames, masses: np.ndarray, coms: np.ndarray) -> np.ndarray:
    """d torque / d lean of the base about its x and y; (m, n, 2) [Nm/rad]."""
    g = float(np.linalg.norm(GRAVITY))
    aside = ((0.0, g, 0.0), (-g, 0.0, 0.0))
    return np.stack([gravity_torques(chain, frames, masses, coms, np.array(to)) for to in aside], axis=2)


def _holding(chain: Chain, frames: Frames, j: int, first, total, gravity: np.ndarray = GRAVITY) -> np.ndarray:
    """-(axis . (sum m (c - p) x g)), or -(axis . g) sum m for a sliding joint."""
    axis = frames.axes[:, j]
    if chain.prismatic[j]:
        return -(axis @ gravity) * np.broadcast_to(np.squeeze(total), axis.shape[:1])
    moment = np.cross(first - total * frames.joint_positions[:, j], gravity)
    return -np.einsum("mi,mi->m", axis, moment)
