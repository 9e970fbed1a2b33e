"""What is taken away from two robots: the relation as a file and as a page."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

import msgspec

from app.calibration.base.page import base_page
from app.calibration.base.report import base_json
from app.screens._base.run import Run

if TYPE_CHECKING:
    from app.screens.context import Context


def send_relation(context: Context, run: Run) -> None:
    """The object that `teachframe base --json` prints."""
    content = msgspec.json.format(msgspec.json.encode(base_json(run.bases, run.relation)), indent=2)
    _send(context, "two_robots.json", content)


def send_page(context: Context, run: Run) -> None:
    """The sheet, in the operator's language."""
    page = base_page(
        [arm.robot.said("title", context.language) for arm in run.cell.arms],
        run.bases,
        run.relation,
        made=datetime.now().strftime("%Y-%m-%d %H:%M"),
        language=context.language,
    )
    _send(context, "two_robots.html", page.encode("utf-8"))


def _send(context: Context, name: str, content: bytes) -> None:
    context.send(name, content)
    context.say("good", context.t("message.given", name=name))
