"""Residual against what it may follow: the numbers behind the plots of the page and of the pendant.

A residual is a vector; a plot needs one number. Along the driver of a joint it is what that joint would have to
be off by to give this residual; elsewhere the direction in which the residual follows the driver most.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.report.labels import Driver, driver
from app.diagnosis.result import Diagnosis, Evidence
from app.kinematics import RobotModel
from app.units import deg, mm

BINS = 14
_LEAST_IN_BIN = 3
_FEWEST = 8  # samples below which nothing is plotted
#: A joint's lever shorter than this share of its longest says nothing about the joint's angle.
_SHORT_LEVER = 0.15


@dataclass(frozen=True, eq=False)
class Curve:
    """One plot.

    Args:
        driver: what stands on the x axis, with its unit.
        response: what stands on the y axis, with its unit.
        x: (k,) driver.
        before: (k,) residual without the findings.
        after: (k,) with them.
        centres: (b,) middle of each bin of the driver.
        mean_before: (b,) mean residual in the bin.
        mean_after: (b,) likewise.
        share: how much of the residual's variance before the binned mean explains, 0..1.
        found: True where a finding, or what is left over, names this driver.
    """

    driver: str
    response: str
    x: np.ndarray
    before: np.ndarray
    after: np.ndarray
    centres: np.ndarray
    mean_before: np.ndarray
    mean_after: np.ndarray
    share: float
    found: bool


def driver_curves(diagnosis: Diagnosis, robot: RobotModel | None, most: int = 6) -> tuple[Curve, ...]:
    """Curves worth looking at: those of the findings first, then what explains most before.

    Args:
        robot: gives the joints' levers; without it residuals are shown along their main direction.
        most: how many at most.
    """
    evidence = diagnosis.evidence
    if evidence is None or not len(evidence.q):
        return ()
    named = {name for f in diagnosis.findings for name in _wanted(f.where)}
    if diagnosis.verdict in ("partly", "unexplained"):
        named |= set(_wanted(diagnosis.leftover.where))
    curves = []
    for source in _drivers(evidence, diagnosis, robot):
        curve = _curve(source, evidence, robot, (source.key, source.joint) in named)
        if curve is not None:
            curves.append(curve)
    # What explains no more than chance would in so many bins is not worth a picture; two are shown anyway.
    telling = [c for c in curves if c.found or c.share > 2.0 * len(c.centres) / len(c.x)]
    curves = telling if len(telling) >= 2 else sorted(curves, key=lambda c: (not c.found, -c.share))[:2]
    curves.sort(key=lambda c: (not c.found, -c.share))
    return tuple(curves[:most])


def _wanted(where) -> list[tuple[str, int | None]]:
    driver, joint = where.get("driver"), where.get("joint")
    if driver is None:
        return [("time", None)] if "from_row" in where or "from_s" in where else []
    source = where.get("source_joint", joint)
    whose = None if driver in ("time", "temperature") else source
    return [(str(driver), None if whose is None else int(whose))]


def _drivers(evidence: Evidence, diagnosis: Diagnosis, robot: RobotModel | None) -> list[Driver]:
    """What the engine gave, and what the findings name and can be had from the joint positions."""
    drivers = [driver(str(label), values) for label, values in evidence.drivers.items()]
    present = {(d.key, d.joint) for d in drivers}
    for finding in diagnosis.findings:
        for key, joint in _wanted(finding.where):
            if (key, joint) in present or (joint is not None and joint > evidence.q.shape[1]):
                continue
            present.add((key, joint))
            if key == "own_angle" and joint is not None:
                slides = robot is not None and robot.joints[joint - 1].prismatic
                drivers.append(driver(f"q{joint} [{'m' if slides else 'rad'}]", evidence.q[:, joint - 1]))
            elif key == "gravity_torque" and joint is not None and robot is not None and robot.has_inertials:
                torque = robot.gravity_torques(evidence.q)[:, joint - 1]
                drivers.append(driver(f"gravity torque {joint} [Nm]", torque))
            elif key == "time" and evidence.seconds is not None:
                drivers.append(driver("time [s]", evidence.seconds))
            elif key == "time":
                drivers.append(Driver("time", None, "line of the file", evidence.rows.astype(float)))
    return drivers


def _curve(source: Driver, evidence: Evidence, robot: RobotModel | None, found: bool) -> Curve | None:
    x = source.values
    good = evidence.kept & np.isfinite(x)
    if good.sum() < _FEWEST or np.ptp(x[good]) == 0:
        return None
    response, before, after, weight = _response(source.joint, x, good, evidence, robot)
    good &= np.isfinite(before) & np.isfinite(after) & (weight > 0)
    if good.sum() < _FEWEST or np.ptp(x[good]) == 0:
        return None
    x, before, after, weight = x[good], before[good], after[good], weight[good]
    centres, mean_before, share = binned(x, before, weight)
    _, mean_after, _ = binned(x, after, weight)
    return Curve(source.label, response, x, before, after, centres, mean_before, mean_after, share, found)


def _response(
    joint: int | None, x: np.ndarray, good: np.ndarray, evidence: Evidence, robot: RobotModel | None
) -> tuple[str, np.ndarray, np.ndarray, np.ndarray]:
    """What to plot: label, before, after, weight of each sample."""
    ones = np.ones(len(x))
    if evidence.unit == "Nm":
        if joint is None or joint > evidence.before.shape[1]:
            shares = [binned(x[good], column[good], ones[good])[2] for column in evidence.before.T]
            joint = int(np.argmax(shares)) + 1
        k = joint - 1
        return (
            f"torque error of {evidence.components[k]} [Nm]",
            evidence.before[:, k],
            evidence.after[:, k],
            ones,
        )
    known = evidence.points_predicted_before is not None and residual_vectors(evidence)[0] is not None
    if joint is not None and robot is not None and joint <= robot.joint_count and known:
        return _as_joint_error(joint, evidence, robot)
    direction = _main_direction(x[good], evidence.before[good])
    before, after = evidence.before @ direction, evidence.after @ direction
    return "error along its main direction [mm]", mm(before), mm(after), ones


def _as_joint_error(
    joint: int, evidence: Evidence, robot: RobotModel
) -> tuple[str, np.ndarray, np.ndarray, np.ndarray]:
    """What this joint would have to be off by: J.r / J.J, exact for a fault of the joint itself."""
    points, first, rest = evidence.points_predicted_before, *residual_vectors(evidence)
    assert points is not None and first is not None and rest is not None
    chain = robot.chain
    lever = chain.jacobian_columns(chain.frames(evidence.q), points)[:, :, joint - 1]  # (m, 3)
    square = np.einsum("mi,mi->m", lever, lever)
    weight = np.where(square > (_SHORT_LEVER**2) * square.max(initial=0.0), square, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        before = np.einsum("mi,mi->m", first, lever) / square
        left = np.einsum("mi,mi->m", rest, lever) / square
    if robot.joints[joint - 1].prismatic:
        return f"joint {joint} off by [mm]", mm(before), mm(left), weight
    return f"joint {joint} off by [deg]", deg(before), deg(left), weight


def residual_vectors(evidence: Evidence) -> tuple[np.ndarray | None, np.ndarray | None]:
    """(m, 3) measured minus predicted in base [m], before and after; None where there are no points."""
    if evidence.vectors_before is not None and evidence.vectors_after is not None:
        return evidence.vectors_before, evidence.vectors_after
    measured, first = evidence.points_measured, evidence.points_predicted_before
    if measured is None or first is None:
        return None, None
    last = evidence.points_predicted_after
    return measured - first, measured - (first if last is None else last)


def _main_direction(x: np.ndarray, residual: np.ndarray) -> np.ndarray:
    """(k,) unit: along it the binned mean of the residual varies most."""
    clean = np.nan_to_num(residual)
    which, count = _bins(x)
    means = np.zeros((count, clean.shape[1]))
    for b in range(count):
        inside = which == b
        means[b] = clean[inside].mean(0) * np.sqrt(inside.sum())
    return np.linalg.svd(means, full_matrices=False)[2][0]


def _bins(x: np.ndarray) -> tuple[np.ndarray, int]:
    """Bin of each sample and their number: each value its own where there are few, else about as many in each."""
    values, which = np.unique(x, return_inverse=True)
    if len(values) > BINS:
        count = max(min(BINS, len(x) // _LEAST_IN_BIN), 1)
        edges = np.unique(np.quantile(x, np.linspace(0, 1, count + 1)))[1:-1]
        values, which = np.unique(np.searchsorted(edges, x, side="right"), return_inverse=True)
    return which, len(values)


def binned(x: np.ndarray, y: np.ndarray, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Weighted mean of y in bins of x: centres (b,), means (b,), share of y's variance they explain."""
    which, count = _bins(x)
    mass = np.bincount(which, weight, count)
    means = np.bincount(which, weight * y, count) / mass
    centres = np.bincount(which, weight * x, count) / mass
    overall = float(np.average(y, weights=weight))
    total = float(np.sum(weight * (y - overall) ** 2))
    told = float(np.sum(mass * (means - overall) ** 2))
    return centres, means, told / total if total > 0 else 0.0
