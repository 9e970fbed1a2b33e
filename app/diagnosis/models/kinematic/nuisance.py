"""Columns of the nuisance parameters, their names, and a first guess for them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.kinematic.setup import Setup
from app.errors import DegenerateGeometryError
from app.geometry import nearest_rotation

if TYPE_CHECKING:
    from app.diagnosis.models.kinematic.sensitivity import Sensitivity
    from app.diagnosis.observations.pose_data import StaticRecording


#: Rounds of "rigid motion, then tool" before Gauss-Newton takes over, at most, and m by which the tool still moves.
_ALTERNATIONS, _NEAR = 12, 1e-6
#: Of the largest: a direction of the tool that turns less (squared) is not told by the rows.
_TOLD = 1e-9


def nuisance_columns(recording: StaticRecording, columns: Sensitivity) -> np.ndarray:
    """(m, k, p) whitened, per session base 6 (draw-wire: 3), tool 3 a reflector (with orientation 3 more);
    for unknown targets tool 3 and 3 a target."""
    m, k = columns.weights.shape
    if recording.mode == "targets":
        count = len(recording.target_names)
        out = np.zeros((m, k, 3 + 3 * count))
        out[:, :, :3] = columns.tool[:, :, :3]
        for c in range(3):  # measured = target - tool point, so a target counts against the point
            out[np.arange(m), c, 3 + 3 * recording.target + c] = -columns.weights[:, c]
        return out
    parts = []
    for s in range(recording.session_count):
        mask = (recording.session == s).astype(float)[:, None, None]
        parts.append(columns.base[:, :, : 3 if recording.mode == "length" else 6] * mask)
        for r in range(recording.reflectors):
            tool = columns.tool[:, :, :3]
            if recording.mode == "points":
                only = np.zeros((1, k, 1))
                only[0, 3 * r : 3 * r + 3] = 1.0
                tool = tool * only
            parts.append(tool * mask)
        if recording.orientations is not None:
            turn = columns.tool[:, :, 3:].copy()
            turn[:, : 3 * recording.reflectors] = 0.0  # the reflectors have their own parameters
            parts.append(turn * mask)
    return np.concatenate(parts, axis=2)


def starting_setup(recording: StaticRecording, rotations: np.ndarray, positions: np.ndarray) -> Setup:
    """A first guess from the nominal arm.

    Args:
        rotations: (m, 3, 3) of the flange in base.
        positions: (m, 3) [m] of the flange in base.

    Raises:
        DegenerateGeometryError: fewer than three different positions in a session.
    """
    sessions, r = max(recording.session_count, 1), recording.reflectors
    eye = np.repeat(np.eye(3)[None], sessions, axis=0)
    if recording.mode == "targets":
        tool, targets = _touches(recording, rotations, positions)
        return Setup(eye, np.zeros((sessions, 3)), tool[None, None], eye, targets)
    out_r, out_p, tools, mounts = eye.copy(), np.zeros((sessions, 3)), np.zeros((sessions, r, 3)), eye.copy()
    for s in range(sessions):
        rows = recording.session == s
        if recording.mode == "length":
            assert recording.lengths is not None
            seen = rows & np.isfinite(recording.lengths)
            out_p[s] = -_anchor(positions[seen], recording.lengths[seen])
            continue
        assert recording.points is not None
        out_r[s], out_p[s], tools[s] = _rigid(recording.points[rows], rotations[rows], positions[rows])
        if recording.orientations is not None:
            seen = np.isfinite(recording.orientations[rows]).all(axis=(1, 2))
            hand = out_r[s] @ rotations[rows][seen]
            mounts[s] = nearest_rotation(
                np.sum(np.swapaxes(hand, 1, 2) @ recording.orientations[rows][seen], axis=0)
            )
    return Setup(out_r, out_p, tools, mounts, np.zeros((0, 3)))


def _touches(recording: StaticRecording, rotations: np.ndarray, positions: np.ndarray):
    """Tool and targets by linear least squares: R_i t - target = -p_i, targets eliminated by centring."""
    count = len(recording.target_names)
    number = np.bincount(recording.target, minlength=count)[:, None]
    mean_r, mean_p = np.zeros((count, 9)), np.zeros((count, 3))
    np.add.at(mean_r, recording.target, rotations.reshape(-1, 9))
    np.add.at(mean_p, recording.target, positions)
    mean_r, mean_p = mean_r / np.maximum(number, 1), mean_p / np.maximum(number, 1)
    a = (rotations.reshape(-1, 9) - mean_r[recording.target]).reshape(-1, 3)
    b = -(positions - mean_p[recording.target]).reshape(-1)
    tool = np.linalg.lstsq(a, b, rcond=1e-9)[0]
    return tool, mean_r.reshape(-1, 3, 3) @ tool + mean_p


def _rigid(measured: np.ndarray, rotations: np.ndarray, positions: np.ndarray):
    """Instrument from base and tool points: rigid motion and tool in turn, tool first taken as zero."""
    reflectors = measured.shape[1]
    tools = np.zeros((reflectors, 3))
    seen = np.isfinite(measured).all(axis=2)  # (m, r)
    if np.count_nonzero(seen.sum(axis=1)) < 3:
        raise DegenerateGeometryError(
            "fewer than three measured points in a session", needed=3, code="too_few",
            advice="measure more poses",
        )  # fmt: skip
    rotation, origin = np.eye(3), np.zeros(3)
    solvers = [
        (r, rows, *_centred(rotations[rows])) for r, rows in enumerate(np.asarray(seen).T) if rows.sum() >= 3
    ]
    for _ in range(_ALTERNATIONS):
        before = tools.copy()
        here = positions[:, None] + np.einsum("mij,rj->mri", rotations, tools)
        a, b = measured[seen], here[seen]
        ca, cb = a.mean(axis=0), b.mean(axis=0)
        rotation = nearest_rotation((a - ca).T @ (b - cb))
        origin = ca - rotation @ cb
        for r, rows, turned, solve in solvers:
            # origin and tool together, so that the alternation converges quickly
            off = measured[rows, r] @ rotation - positions[rows]
            tools[r] = solve @ np.einsum("mij,mi->j", turned, off - off.mean(axis=0))
        if np.abs(tools - before).max() < _NEAR:
            break
    return rotation, origin, tools


def _centred(rotations: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rotations (m, 3, 3) less their mean, and the (3, 3) pseudo-inverse of the sum of their squares."""
    turned = rotations - rotations.mean(axis=0)
    values, vectors = np.linalg.eigh(np.einsum("mij,mik->jk", turned, turned))
    told = values > _TOLD * max(float(values[-1]), 1e-300)
    return turned, (vectors[:, told] / values[told]) @ vectors[:, told].T


def _anchor(positions: np.ndarray, lengths: np.ndarray) -> np.ndarray:
    """Where a draw-wire hangs, from |p - a|^2 = L^2, linear in a and |a|^2."""
    design = np.column_stack([-2.0 * positions, np.ones(len(positions))])
    rhs = lengths**2 - np.sum(positions**2, axis=1)
    return np.linalg.lstsq(design, rhs, rcond=1e-9)[0][:3]
