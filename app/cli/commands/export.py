"""Writes a tool frame the way a controller reads it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import tyro


@dataclass
class Command:
    """Writes a tool frame the way a controller reads it.

    SOURCE is a points file, which is solved first, or a tool frame in any of the formats. Of several tools in a
    controller's file --tool chooses one; without it they are listed and nothing is written.
    """

    source: Annotated[Path, tyro.conf.Positional]
    """Points file, or a tool frame of any known format."""
    to: Literal[
        "abb_rapid", "csv", "fanuc_utool", "json", "kuka_krl", "ros_static", "ur_script", "urdf_joint"
    ] = "json"
    """The format to write."""
    tool: Annotated[str | None, tyro.conf.arg(metavar="NAME|NUMBER")] = None
    """Which tool of a file that holds several."""
    name: str | None = None
    """Name of the tool on the controller."""
    mass_kg: float | None = None
    """Mass of the tool."""
    com_mm: tuple[float, float, float] | None = None
    """Its centre of mass in the flange."""
    out: Path | None = None
    """File to write; without it: stdout."""

    def run(self) -> int:
        import math

        from app.calibration.exchange import ToolFrame, exchange_format, holds_tools, read_frame
        from app.errors import InputError
        from app.files import write_text
        from app.units import from_mm

        if holds_tools(self.source):
            frame = read_frame(self.source, tool=self.tool)
        elif self.tool is not None:
            raise InputError(
                "not a controller's file", file=self.source, column="--tool", expected="no --tool"
            )
        else:
            frame = ToolFrame(self.source.stem, self._solved())
        if self.com_mm is not None and not all(math.isfinite(v) and abs(v) < 1e6 for v in self.com_mm):
            raise InputError(f"found {self.com_mm}", column="--com-mm", expected="three finite numbers")
        if self.mass_kg is not None and not 0.0 <= self.mass_kg < 1e4:
            raise InputError(f"a mass of {self.mass_kg} kg", expected="0 or more")
        x, y, z = frame.com if self.com_mm is None else (from_mm(v) for v in self.com_mm)
        mass = frame.mass if self.mass_kg is None else self.mass_kg
        text = exchange_format(self.to).write(ToolFrame(self.name or frame.name, frame.pose, mass, (x, y, z)))
        if self.out is None:
            print(text, end="")
            return 0
        write_text(self.out, text)
        return 0

    def _solved(self):
        """The tool frame of a points file; a file that is none of all this is told so."""
        from app.calibration.solving import solve_file
        from app.errors import FileFormatError, MissingColumnError

        try:
            return solve_file(self.source).result.T_flange_tool
        except MissingColumnError as error:
            if error.column != "role":
                raise
            raise FileFormatError(
                "no tool frame in this file, and no points",
                file=self.source,
                expected="a tool of a known format, or a points file with a column role",
            ) from None
