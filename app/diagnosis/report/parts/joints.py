"""One row a joint: everything that was found of it, each value with its 95% interval."""

from __future__ import annotations

from markupsafe import Markup

from app.diagnosis.quantity import quantity
from app.diagnosis.report.budget import budget
from app.diagnosis.report.parts.case import Case
from app.diagnosis.report.wording import effect_title, parameter_name
from app.diagnosis.result import Finding
from app.estimation import LEVEL

_HEAD = f"± {LEVEL:.0%}"  # of every value in the table
#: Columns of values beside each other on one page.
_MOST_COLUMNS = 5
#: What tells laws of one effect on one joint apart -> how it is written: axis, waves a turn, the joint that moves it.
_MARKS = {"axis": "", "order": "n=", "source_joint": "← "}


def joints(case: Case) -> Markup | str:
    """Columns in the budget's order; nothing where fewer than two findings belong to joints or links."""
    found = [f for f in case.diagnosis.findings if _number(f) is not None]
    if len(found) < 2:
        return ""
    in_order = [k for step in budget(case.diagnosis).steps for k in (*step.members, *step.small)]
    first_of = {id(case.diagnosis.findings[k]): place for place, k in enumerate(in_order)}
    ordered = sorted(found, key=lambda f: first_of.get(id(f), len(in_order)))
    effects = list(dict.fromkeys(f.effect for f in ordered))
    last = len(case.robot.joints) if case.robot else max(_number(f) or 0 for f in found)
    tables = []
    for first in range(0, len(effects), _MOST_COLUMNS):
        shown = effects[first : first + _MOST_COLUMNS]
        heads = [_HEAD, *(effect_title(e, case.language) for e in shown)]
        rows = [
            [case.t("joints.joint", n=n), *(_cell(case, found, n, e) for e in shown)]
            for n in range(1, last + 1)
        ]
        tables.append((heads, rows))
    return case.section("joints.html", tables=tables)


def _number(f: Finding) -> int | None:
    """The joint, or the link that it moves."""
    number = f.where.get("joint", f.where.get("link"))
    return None if number is None else int(number)


def _cell(case: Case, found: list[Finding], number: int, effect: str) -> str:
    """Values of one effect on one joint; more than one law or value is told apart by its name."""
    mine = [f for f in found if _number(f) == number and f.effect == effect]
    several = len(mine) > 1 or any(len(f.parameters) > 1 for f in mine)
    said = []
    for f in mine:
        mark = "".join(f"{sign}{f.where[k]} " for k, sign in _MARKS.items() if k in f.where)
        for p in f.parameters:
            name = f"{mark}{parameter_name(p.name, case.language)} " if several else mark
            said.append(f"{name}{quantity(p, case.language, marked=False)}")
    return "; ".join(said)
