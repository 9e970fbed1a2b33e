"""One bar a joint: what of its torque error is taken away by which family, and what is left."""

from __future__ import annotations

import numpy as np

from app.diagnosis.report.budget import in_order
from app.diagnosis.report.drawing import svg
from app.diagnosis.report.drawing.palette import NOISE, colour
from app.diagnosis.report.wording import digits
from app.diagnosis.result import Evidence

WIDTH, LEFT, RIGHT, BAR, GAP = 680.0, 60.0, 60.0, 15.0, 6.0


def joint_bars(evidence: Evidence) -> str:
    """Bars of the rms error before [Nm], divided in the order of the families; "" where no parts are known."""
    if not evidence.parts:
        return ""
    amounts = [_amounts(evidence, k) for k in range(evidence.before.shape[1])]
    top = max(sum(a for _, a in joint) for joint in amounts) or 1.0
    scale = (WIDTH - LEFT - RIGHT) / top
    out = []
    for k, joint in enumerate(amounts):
        y = 4 + k * (BAR + GAP)
        out.append(svg.text(LEFT - 8, y + BAR - 4, evidence.components[k], klass="label end"))
        x = LEFT
        for fill, amount in joint:
            out.append(svg.tag("rect", x=x, y=y, width=max(amount * scale - 0.5, 0.0), height=BAR, fill=fill))
            x += amount * scale
        total = sum(a for _, a in joint)
        out.append(svg.text(x + 5, y + BAR - 4, f"{digits(total, 2)} Nm", klass="value"))
    return svg.picture(WIDTH, 4 + len(amounts) * (BAR + GAP), out, "torque error of each joint by family")


def _amounts(evidence: Evidence, joint: int) -> list[tuple[str, float]]:
    """Colour and fall of the rms error with each family added [Nm]; the last is what is left."""
    kept = evidence.kept
    left = np.nan_to_num(evidence.before[kept, joint])
    reached, out = _rms(left), []
    for family, part in in_order(evidence.parts).items():
        left = left - np.nan_to_num(part[kept, joint])
        after = min(reached, _rms(left))
        out.append((colour(family), reached - after))
        reached = after
    return [*out, (NOISE, reached)]


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2))) if len(values) else 0.0
