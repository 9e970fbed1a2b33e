"""What a replay prints: the same page, and the same JSON, as `teachframe solve` for the same points."""

from __future__ import annotations

from datetime import datetime

import msgspec
import numpy as np

from app.calibration.as_json import solved_json
from app.calibration.text import page
from app.figures import unsigned
from app.geometry import CONVENTIONS
from app.session.state import SessionState, TwoRobots, mode_named
from app.simulation.tracker_cell import make_cell
from app.simulation.tracker_procedure import senses
from app.units import deg, mm


def moment(seconds: float, form: str = "%Y-%m-%d %H:%M") -> str:
    """A time [s since 1970] as a person reads it; `?` for one that no calendar has."""
    try:
        return datetime.fromtimestamp(seconds).strftime(form)
    except (OverflowError, ValueError, OSError):
        return "?"


def report_text(state: SessionState) -> str:
    """The result as a page; where there is none, what is still missing. With the user frame, where it was set."""
    return unsigned("\n".join([_work(state), *_load(state), *_user_frame(state)]))


def _load(state: SessionState) -> list[str]:
    if state.load is None:
        return []
    found = state.load.found
    if found is None:
        return [f"load data: {len(state.load.poses)} poses of the run recorded, not weighed"]
    x, y, z = mm(np.array(found.centre))
    halves = ", ".join(f"{v:.1f}" for v in mm(np.array(found.centre_half)))
    return [
        f"load data: {found.mass:.3f} ± {found.mass_half:.3f} kg, centre {x:.1f}, {y:.1f}, {z:.1f} mm "
        f"± {halves} mm in the flange (95%)"
    ]


def _user_frame(state: SessionState) -> list[str]:
    if state.user_frame is None:
        return []
    x, y, z = mm(state.user_frame.position)
    a, b, c = deg(CONVENTIONS["ZYX"].from_rotation(state.user_frame.rotation))
    return [f"user frame: {x:.2f}, {y:.2f}, {z:.2f} mm; A, B, C {a:.3f}, {b:.3f}, {c:.3f} deg (ZYX)"]


def _work(state: SessionState) -> str:
    if state.result is not None:
        return page(state.result)
    if state.two_robots is not None:
        return two_robots_text(state.two_robots)
    recorded, missing = len(state.captures), ", ".join(step.title for step in state.missing)
    lines = [
        f"{state.model.title}, {mode_named(state.mode).title}: {recorded} of {len(state.steps)} points, no result"
    ]
    if missing:
        lines.append(f"not recorded: {missing}")
    lines += [f"accepted: {tool.name}" for tool in state.tools]
    return "\n".join(lines)


def two_robots_text(work: TwoRobots) -> str:
    """The relation found; before the end, what is done and what comes next."""
    opened, wizard = work.opened, work.wizard
    head = f"two robots: {opened.first} and {opened.second}, {len(wizard.records)} points measured"
    if not wizard.done:
        return f"{head}\n{wizard.summary()}"
    cell = make_cell(opened.first, opened.second, opened.seed)
    bases, relation = wizard.solve(tuple(arm.robot for arm in cell.arms), senses(cell))
    lines = [head]
    for number, base in enumerate(bases, 1):
        x, y, z = mm(base.T_tracker_base.position)
        lines.append(f"base {number} in its tracker frame: {x:.3f}, {y:.3f}, {z:.3f} mm")
        lines += [f"  {warning.message}" for warning in base.warnings]
    if relation is not None and relation.T_base1_base2 is not None:
        x, y, z = mm(relation.T_base1_base2.position)
        lines.append(f"base 2 in base 1: {x:.3f}, {y:.3f}, {z:.3f} mm")
        lines += [f"  {warning.message}" for warning in relation.warnings]
    return "\n".join(lines)


def report_json(state: SessionState) -> str | None:
    """The object teachframe.tool/1 on one line; None without a result."""
    return None if state.result is None else msgspec.json.encode(solved_json(state.result)).decode()
