"""Runs a recorded pendant session again without a browser and prints the same result."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro


@dataclass
class Command:
    """Runs a recorded pendant session again without a browser and prints the same result.

    SESSION is the path of an exported journal, the folder it lies in, or a session's name (or the beginning of it) in
    the store (`teachframe sessions` lists them).
    """

    session: Annotated[str, tyro.conf.Positional, tyro.conf.arg(metavar="SESSION")]
    """Journal, folder or name."""
    data: Path | None = None
    """The data folder the pendant was started with; without it the user's own."""
    database: str | None = None
    """URL of the database the pendant was started with; without it the one in the data folder."""
    robot: str | None = None
    """Stands for an arm of the session that is neither shipped nor kept here: its description."""
    json: bool = False
    """The object teachframe.tool/1 instead of the page."""

    def run(self) -> int:
        from app.errors import InputError
        from app.kinematics import load_robot
        from app.session import replay
        from app.session.actions import ChooseRobot
        from app.session.report import report_json, report_text
        from app.session.state import grant_robot, known_robot
        from app.session.store import find_recorded

        recorded = find_recorded(self.session, self.data, self.database)
        description = self.robot
        if description is not None:
            arms = {e.action.robot for e in recorded.entries if isinstance(e.action, ChooseRobot)}
            for name in arms:
                if not known_robot(name):
                    grant_robot(name, lambda _: load_robot(description))
        state = replay(recorded)
        if recorded.torn:
            print(
                f"teachframe replay: {recorded.source}: the last line was not finished (the pendant was stopped while "
                "writing it) and is left out",
                file=sys.stderr,
            )
        if not self.json:
            print(report_text(state))
            return 0
        line = report_json(state)
        if line is None:
            raise InputError(
                "this session has no result",
                file=recorded.source,
                expected="a session with Calculate at its end",
            )
        print(line)
        return 0
