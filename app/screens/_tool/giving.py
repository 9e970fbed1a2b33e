"""What the operator takes away and brings along: tool frames in the makers' formats, the report."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

from app.calibration.exchange import ToolFrame, exchange_format, read_frame
from app.calibration.report import report
from app.panel import Upload
from app.screens._tool.paper import calculate
from app.screens._tool.words import Words
from app.screens.taking_in import Around, take_small
from app.session.actions import ChooseMode, Enter
from app.session.state import DIRECT, as_tuple, mode_named

if TYPE_CHECKING:
    from app.screens.context import Context

_LARGEST = 1_000_000  # bytes of a tool frame somebody may send


def send_frame(context: Context, key: str, name: str) -> None:
    """The result as a file in one of the formats."""
    solved = context.session.state.result
    if solved is None:
        return
    form = exchange_format(key)
    frame = ToolFrame(name, solved.result.T_flange_tool)
    file = f"{frame.name}{form.suffix}"
    context.send(file, form.write(frame).encode("utf-8"))
    context.say("good", context.t("message.given", name=file))


def send_report(context: Context, name: str) -> None:
    """The sheet with signature lines, in the operator's language."""
    solved = context.session.state.result
    if solved is None:
        return
    state = context.session.state
    page = report(
        solved,
        name=name,
        made=datetime.now().strftime("%Y-%m-%d %H:%M"),
        language=context.language,
        of=Words(context).mode(mode_named(state.mode)) if state.source is None else "",
    )
    file = f"{ToolFrame(name, solved.result.T_flange_tool).name}.html"
    context.send(file, page.encode("utf-8"))
    context.say("good", context.t("message.given", name=file))


def take_frame(context: Context, upload: Upload, around: Around) -> None:
    """A tool frame somebody sent, in any of the formats: it stands there as if it had been typed."""

    def use(frame: ToolFrame) -> None:
        x, y, z = as_tuple(frame.pose.position)
        context.do(ChooseMode(DIRECT))
        context.do(Enter((x, y, z), as_tuple(frame.pose.quaternion), "quaternion"))
        calculate(context)
        context.say("info", context.t("message.taken_frame", name=frame.name, file=upload.name))

    take_small(context, upload, _LARGEST, read_frame, use, around)
