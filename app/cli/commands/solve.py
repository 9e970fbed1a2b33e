"""Tool frame from a points file, with its uncertainty."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Annotated, Literal

import tyro

from app.cli.arguments import RobotArguments


@dataclass
class Command:
    """Tool frame from a points file, with its uncertainty.

    Several files: one page a file; with --json one object a line, in order. A file that cannot be used is named on
    stderr, the others still come out, and the exit code is 2.
    """

    files: Annotated[tuple[Path, ...], tyro.conf.Positional, tyro.conf.arg(metavar="FILE...")]
    """Points files (# kind: points), or touch recordings (# kind: touch) of many points with one tool."""
    method: Literal["joint", "pairwise", "robust"] = "joint"
    """joint: order-free. pairwise: the estimator of Xiong 2012. robust: far-off touches count less."""
    orientation: Literal["default", "z", "zx", "xy"] | None = None
    """How the axes are found; without it: the fullest that the roles in the file allow."""
    mode: str | None = None
    """Solve by a wizard mode instead (plane, spin, reference, abc_two_point, …)."""
    json: bool = False
    """The object teachframe.tool/1 instead of the page."""

    language: Literal["en", "zh"] = "en"
    """Of the page and the report; JSON stays English."""

    arm: tyro.conf.OmitArgPrefixes[RobotArguments] = field(default_factory=RobotArguments)
    """The robot, for joints; without it the one the file names."""

    report: Path | None = None
    """Writes a one-page report (HTML, prints well) of the one file given."""

    def run(self) -> int:
        import msgspec

        from app.calibration.as_json import solved_json, tool_json
        from app.calibration.report import report
        from app.calibration.sockets import sockets_page, solve_sockets
        from app.calibration.solving import solve_file
        from app.calibration.text import page
        from app.errors import InputError, TeachframeError
        from app.files import write_text
        from app.recordings import read_table

        if not self.files:
            raise InputError("no points file given", expected="teachframe solve FILE…")
        if self.report is not None and len(self.files) != 1:
            raise InputError("a report is of one file", column="--report", expected="one FILE")
        code = 0
        for number, path in enumerate(self.files):
            try:
                if self.mode is None and self.report is None and (table := read_table(path)).kind == "touch":
                    found = solve_sockets(table, self.arm.address)
                    text = (
                        msgspec.json.encode({**tool_json(found.result), "flange": found.flange}).decode()
                        if self.json
                        else sockets_page(found)
                    )
                    print(text, flush=True)
                    continue
                solved = solve_file(
                    path,
                    method=self.method,
                    orientation=self.orientation,
                    mode_key=self.mode,
                    robot=self.arm.address,
                )
            except TeachframeError as error:
                print(f"teachframe solve: {error}", file=sys.stderr, flush=True)
                code = 2
                continue
            if self.report is not None:
                write_text(
                    self.report,
                    report(solved, made=datetime.now().strftime("%Y-%m-%d %H:%M"), language=self.language),
                )
            if self.json:
                print(msgspec.json.encode(solved_json(solved)).decode(), flush=True)
            else:
                text = page(solved, self.language)
                print(("\n" + "=" * 100 + "\n\n" if number else "") + text, flush=True)
        return code
