"""The real arm beside its description, as JSON and as text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from app.calibration.base.sixaxis import ArmGeometry, Quantity
from app.calibration.base.wording import TEXTS
from app.estimation import HALF
from app.kinematics import RobotModel
from app.phrases import FALLBACK, padded
from app.units import deg, mm

#: Half widths of the 95% interval; by chance a row is further off its description 3 times in 1,000.
_BEYOND = 1.5


def _in(quantity: Quantity, value: float | None) -> float | None:
    if value is None:
        return None
    return deg(value) if quantity.angular else mm(value)


def arm_json(arm: ArmGeometry) -> dict[str, Any]:
    """Lengths in mm, angles in degrees."""
    return {
        "quantities": [
            {
                "name": q.name,
                "axis": q.axis,
                "unit": "deg" if q.angular else "mm",
                "measured": _in(q, q.measured),
                "sigma": _in(q, q.sigma),
                "nominal": _in(q, q.nominal),
                "error": _in(q, q.error),
            }
            for q in arm.quantities
        ],
        "turning": [
            {"axis": t.axis, "slope": t.slope, "sigma": t.sigma, "scatter_deg": deg(t.scatter)}
            for t in arm.turning
        ],
    }


def flange_lines(models: Sequence[RobotModel | None], language: str = FALLBACK) -> list[str]:
    """One line an arm: from which link to which its description was taken."""
    return [
        TEXTS.text("arm.flange", language, robot=m.title, joints=m.joint_count, base=m.base, flange=m.flange)
        for m in models
        if m is not None
    ]


def arm_text(arm: ArmGeometry, language: str = FALLBACK) -> str:
    """One row a dimension with its 95% half width; what stands out by more than 1.5 of them is marked."""

    def t(key: str, **fields: Any) -> str:
        return TEXTS.text(f"arm.{key}", language, **fields)

    heads = (("measured", 12), ("half", 10), ("described", 12), ("error", 10))
    lines = [
        "  " + t("title"),
        f"  {'':<23}" + "".join(padded(t(key), width) for key, width in heads),
    ]
    for q in arm.quantities:
        pair = t("pair", first=q.axis, second=q.axis + 1) if q.name in ("a", "twist", "lean") else f"{q.axis}"
        unit = "deg" if q.angular else "mm"
        nominal, error = _in(q, q.nominal), _in(q, q.error)
        beside = (
            f"{'-':>12}{'-':>10}" if nominal is None or error is None else f"{nominal:>12.3f}{error:>+10.4f}"
        )
        telling = q.error is not None and abs(q.error) > _BEYOND * HALF * q.sigma
        figures = f"{_in(q, q.measured):>10.4f}{HALF * (_in(q, q.sigma) or 0.0):>10.4f}{beside} {unit}"
        lines.append(f"  {padded(t(q.name), -17)}{padded(pair, -8)}{figures}{'  *' if telling else ''}")
    lines += [
        "  " + t("turning", axis=r.axis, slope=r.slope, half=HALF * r.sigma, scatter=deg(r.scatter))
        for r in arm.turning
    ]
    if any(q.error is not None for q in arm.quantities):
        lines.append("  * " + t("star"))
    return "\n".join(lines)
