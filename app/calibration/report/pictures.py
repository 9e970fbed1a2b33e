"""Pictures for the sheet, as SVG text. One drawing unit is one pixel."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from app.calibration.quality.leave_one_out import LeftOut
from app.calibration.quality.region import ellipsoid
from app.calibration.result import ToolCalibration
from app.units import deg, mm

INK, SOFT, TIP = "#1d2733", "#8a96a3", "#d9622b"
_AXES = (("X", "#c0392b"), ("Y", "#2e8b57"), ("Z", "#2a62b8"))
_TRIAD = 42.0

#: Text of a key of the sheet, escaped, with its fields put in.
Words = Callable[..., str]


def tool_picture(result: ToolCalibration, words: Words, width: int = 300, height: int = 250) -> str:
    """Flange, tool and tip from the side; the 95% region magnified at the tip."""
    point = mm(result.tool_point)
    across = np.array([point[0], point[1], 0.0])
    side = float(np.linalg.norm(across))
    right = across / side if side > 1e-6 else np.array([1.0, 0.0, 0.0])
    down = np.array([0.0, 0.0, 1.0])
    view = np.stack([right, down])  # (2, 3)
    flat = view @ point
    reach = max(abs(flat[0]), abs(flat[1]), 1.0)
    scale = 0.5 * min(width, height) / reach
    origin = np.array([width / 2 - 0.5 * scale * flat[0], height / 2 - 0.5 * scale * flat[1]])
    tip = origin + scale * flat
    parts = [
        f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{words("picture_tool")}">',
        f'<rect x="{origin[0] - 26:.1f}" y="{origin[1] - 9:.1f}" width="52" height="9" rx="2" fill="{SOFT}"/>',
        line(origin, tip, INK, 5.0, 0.35),
        *_triad(origin, view, np.eye(3), 0.8),
        *_triad(tip, view, result.T_flange_tool.rotation, 1.0),
    ]
    if result.dof > 0:
        region = ellipsoid(result)
        shadow = view @ region.directions @ np.diag(mm(region.semi_axes) ** 2) @ region.directions.T @ view.T
        values, vectors = np.linalg.eigh(shadow)
        factor = _round_down(34.0 / max(float(np.sqrt(values[-1])), 1e-9) / scale)
        a, b = np.sqrt(np.maximum(values[::-1], 0.0)) * scale * factor
        turn = deg(np.arctan2(vectors[1, 1], vectors[0, 1]))
        parts.append(
            f'<ellipse cx="{tip[0]:.1f}" cy="{tip[1]:.1f}" rx="{a:.1f}" ry="{b:.1f}" fill="{TIP}" '
            f'fill-opacity="0.18" stroke="{TIP}" transform="rotate({turn:.1f} {tip[0]:.1f} {tip[1]:.1f})"/>'
        )
        parts.append(text(6, height - 6, words("picture_region", factor=factor), SOFT, 10))
    parts.append(f'<circle cx="{tip[0]:.1f}" cy="{tip[1]:.1f}" r="3.5" fill="{TIP}"/>')
    parts.append(text(origin[0] + 30, origin[1] - 12, words("picture_flange"), SOFT, 10))
    return "".join(parts) + "</svg>"


def error_picture(
    result: ToolCalibration, left_out: Sequence[LeftOut], words: Words, width: int = 330, height: int = 190
) -> str:
    """One bar a touch: its error, and beside it how far the tool point moves without it."""
    distances = mm(result.per_point)
    shifts = {entry.index: mm(entry.shift) for entry in left_out}
    top = max([*distances, *shifts.values(), 1e-6]) * 1.1
    left, bottom, room = 34.0, 26.0, 34.0
    step = (width - left - 8) / len(distances)

    def y(value: float) -> float:
        return height - bottom - (height - bottom - room) * value / top

    parts = [f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{words("picture_error")}">']
    for value in _ticks(top):
        parts.append(line(np.array([left, y(value)]), np.array([width, y(value)]), SOFT, 0.5, 0.5))
        parts.append(text(left - 4, y(value) + 3, f"{value:g}", SOFT, 9, "end"))
    for i, value in enumerate(distances):
        x = left + step * (i + 0.5)
        colour = TIP if i == result.worst else INK
        wide = min(step * 0.32, 22.0)
        parts.append(_bar(x - wide, y(value), wide, height - bottom - y(value), colour))
        if i in shifts:
            parts.append(_bar(x, y(shifts[i]), wide, height - bottom - y(shifts[i]), SOFT))
        parts.append(text(x, height - bottom + 13, str(i + 1), INK, 10, "middle"))
    mean = y(mm(result.mean))
    parts.append(
        f'<line x1="{left}" y1="{mean:.1f}" x2="{width}" y2="{mean:.1f}" stroke="{TIP}" stroke-dasharray="4 3"/>'
    )
    parts.append(text(left, 10, words("picture_dark"), INK, 10))
    if shifts:
        parts.append(text(left, 23, words("picture_light"), SOFT, 10))
    parts.append(text(width / 2, height - 2, words("column_touch"), SOFT, 10, "middle"))
    return "".join(parts) + "</svg>"


def tilt_picture(rotations: np.ndarray, words: Words, width: int = 190, height: int = 190) -> str:
    """Where the flange's Z pointed at each touch, seen along its mean: spread is what determines the tool point."""
    axes = rotations[:, :, 2]
    mean = axes.mean(axis=0)
    length = float(np.linalg.norm(mean))
    mean = mean / length if length > 1e-6 else np.array([0.0, 0.0, 1.0])
    helper = np.eye(3)[np.argmin(np.abs(mean))]
    a = np.cross(mean, helper)
    a /= np.linalg.norm(a)
    b = np.cross(mean, a)
    tilts = np.arccos(np.clip(axes @ mean, -1.0, 1.0))
    around = np.arctan2(axes @ b, axes @ a)
    most = max(float(deg(tilts.max())), 15.0)
    centre, scale = np.array([width / 2, height / 2 - 6]), (min(width, height) / 2 - 22) / most
    parts = [f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{words("picture_tilt")}">']
    for ring in (15.0, 30.0, 45.0, 60.0, 90.0):
        if ring <= most + 1.0:
            parts.append(
                f'<circle cx="{centre[0]:.1f}" cy="{centre[1]:.1f}" r="{ring * scale:.1f}" fill="none" '
                f'stroke="{SOFT}" stroke-opacity="0.5"/>'
            )
            parts.append(text(centre[0] + 2, centre[1] - ring * scale - 2, f"{ring:g}°", SOFT, 9))
    for i, (tilt, angle) in enumerate(zip(deg(tilts), around, strict=True)):
        x, y = centre + scale * tilt * np.array([np.cos(angle), np.sin(angle)])
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="7" fill="{INK}"/>')
        parts.append(text(x, y + 3, str(i + 1), "white", 9, "middle"))
    parts.append(text(width / 2, height - 3, words("picture_tilt"), SOFT, 10, "middle"))
    return "".join(parts) + "</svg>"


def arc_picture(
    errors: np.ndarray, used: np.ndarray, caption: str, width: int = 400, height: int = 74
) -> str:
    """One bar a point of an arc: how far it lies off its circle; what was set aside is grey.

    Args:
        errors: (n,) [m].
        used: (n,) False where a point was set aside.
        caption: what it is, escaped.
    """
    values = mm(errors)
    top = max(float(values[used].max(initial=0.0)), 1e-6) * 1.1
    left, low, high = 42.0, 16.0, 8.0
    step = (width - left - 8) / max(len(values), 1)

    def y(value: float) -> float:
        return height - low - (height - low - high) * min(value / top, 1.0)

    parts = [f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{caption}">']
    for value in _ticks(top)[:3]:
        parts.append(line(np.array([left, y(value)]), np.array([width, y(value)]), SOFT, 0.5, 0.5))
        parts.append(text(left - 4, y(value) + 3, f"{value:g}", SOFT, 9, "end"))
    for k, (value, kept) in enumerate(zip(values, used, strict=True)):
        x = left + step * (k + 0.15)
        parts.append(_bar(x, y(value), step * 0.7, height - low - y(value), INK if kept else SOFT))
    parts.append(text(left, height - 3, caption, SOFT, 10))
    return "".join(parts) + "</svg>"


def _triad(place: np.ndarray, view: np.ndarray, rotation: np.ndarray, strength: float) -> list[str]:
    out = []
    for column, (name, colour) in enumerate(_AXES):
        end = place + _TRIAD * strength * (view @ rotation[:, column])
        if np.linalg.norm(end - place) < 6.0:
            continue
        out.append(line(place, end, colour, 2.0, strength))
        out.append(text(end[0] + 3, end[1] + 3, name, colour, 10))
    return out


def line(a: np.ndarray, b: np.ndarray, colour: str, wide: float, strength: float) -> str:
    """A straight line between two places (2,)."""
    return (
        f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" stroke="{colour}" '
        f'stroke-width="{wide}" stroke-opacity="{strength}" stroke-linecap="round"/>'
    )


def _bar(x: float, y: float, wide: float, high: float, colour: str) -> str:
    return f'<rect x="{x:.1f}" y="{y:.1f}" width="{wide:.1f}" height="{max(high, 0.5):.1f}" fill="{colour}"/>'


def text(x: float, y: float, text: str, colour: str, size: int, anchor: str = "start") -> str:
    """A few words, already safe."""
    return f'<text x="{x:.1f}" y="{y:.1f}" fill="{colour}" font-size="{size}" text-anchor="{anchor}">{text}</text>'


def _ticks(top: float) -> list[float]:
    step = _round_down(top / 3.0)
    return [step * k for k in range(int(top / step) + 1)]


def _round_down(value: float) -> float:
    """1, 2 or 5 times a power of ten, not above `value`."""
    power = 10.0 ** np.floor(np.log10(max(value, 1e-12)))
    return float(power * next(m for m in (5.0, 2.0, 1.0) if m * power <= value * (1 + 1e-9)))
