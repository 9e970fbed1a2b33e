"""What is taken away from two robots: the relation as a file and as a page."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

import msgspec

from app.calibration.base.report import base_json
from app.calibration.report import two_robots_report
from app.screens._base.run import Run

if TYPE_CHECKING:
    from app.screens.context import Context


def send_relation(context: Context, run: Run) -> None:
    """The object that `teachframe base --json` prints."""
    content = msgspec.json.format(msgspec.json.encode(base_json(run.bases, run.relation)), indent=2)
    _send(context, "two_robots.json", content)


def send_page(context: Context, run: Run) -> None:
    """The sheet, in the operator's language."""
    met = run.meeting
    page = two_robots_report(
        [arm.robot.said("title", context.language) for arm in run.cell.arms],
        run.bases,
        run.relation,
        made=datetime.now().strftime("%Y-%m-%d %H:%M"),
        language=context.language,
        missed=None if met is None else (met.miss, met.predicted),
    )
    _send(context, "two_robots.html", page.encode("utf-8"))


def _send(context: Context, name: str, content: bytes) -> None:
    context.send(name, content)
    context.say("good", context.t("message.given", name=name))
