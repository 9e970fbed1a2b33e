"""What the operator takes away and brings along: tool frames in the makers' formats, the report."""

from __future__ import annotations

import tempfile
from datetime import datetime
from typing import TYPE_CHECKING

from app.calibration.exchange import ToolFrame, exchange_format, read_frame
from app.calibration.report import report
from app.pendant.screens._tool.paper import calculate
from app.pendant.uploads import put
from app.session.actions import ChooseMode, Enter
from app.session.state import DIRECT, as_tuple

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_LARGEST = 1_000_000  # bytes of a tool frame somebody may send


def send_frame(pendant: Pendant, key: str, name: str) -> None:
    """The result as a file in one of the formats."""
    solved = pendant.session.state.result
    if solved is None:
        return
    form = exchange_format(key)
    frame = ToolFrame(name, solved.result.T_flange_tool)
    file = f"{frame.name}{form.suffix}"
    pendant.client.send_file_download(file, form.write(frame).encode("utf-8"), save_immediately=True)
    pendant.say("good", pendant.t("message.given", name=file))


def send_report(pendant: Pendant, name: str) -> None:
    """The sheet with signature lines, in the operator's language."""
    solved = pendant.session.state.result
    if solved is None:
        return
    page = report(
        solved, name=name, made=datetime.now().strftime("%Y-%m-%d %H:%M"), language=pendant.language
    )
    file = f"{ToolFrame(name, solved.result.T_flange_tool).name}.html"
    pendant.client.send_file_download(file, page.encode("utf-8"), save_immediately=True)
    pendant.say("good", pendant.t("message.given", name=file))


def take_frame(pendant: Pendant, name: str, content: bytes) -> None:
    """A tool frame somebody sent, in any of the formats: it stands there as if it had been typed."""
    with tempfile.TemporaryDirectory() as folder:
        path = put(pendant, folder, name, content, otherwise="tool", most=_LARGEST)
        if path is None:
            return
        frame = read_frame(path)
    x, y, z = as_tuple(frame.pose.position)
    pendant.do(ChooseMode(DIRECT))
    pendant.do(Enter((x, y, z), as_tuple(frame.pose.quaternion), "quaternion"))
    calculate(pendant)
    pendant.say("info", pendant.t("message.taken_frame", name=frame.name, file=name))
