"""Writes a tool frame the way a controller reads it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import tyro


@dataclass
class Command:
    """Writes a tool frame the way a controller reads it.

    SOURCE is a points file, which is solved first, or a tool frame in any of the formats.
    """

    source: Annotated[Path, tyro.conf.Positional]
    """Points file, or a tool frame of any known format."""
    to: Literal[
        "abb_rapid", "csv", "fanuc_utool", "json", "kuka_krl", "ros_static", "ur_script", "urdf_joint"
    ] = "json"
    """The format to write."""
    name: str | None = None
    """Name of the tool on the controller."""
    mass_kg: float | None = None
    """Mass of the tool."""
    com_mm: tuple[float, float, float] | None = None
    """Its centre of mass in the flange."""
    out: Path | None = None
    """File to write; without it: stdout."""

    def run(self) -> int:
        from app.calibration.exchange import ToolFrame, exchange_format, formats, read_frame
        from app.calibration.solving import solve_file
        from app.errors import FileFormatError, InputError
        from app.units import from_mm

        if self.source.is_file():
            with self.source.open("rb") as file:
                head = file.read(65536).decode("utf-8", errors="replace")
        else:
            head = ""
        if any(form.knows(head) for form in formats().values()):
            frame = read_frame(self.source)
        else:
            frame = ToolFrame(self.source.stem, solve_file(self.source).result.T_flange_tool)
        if self.mass_kg is not None and not 0.0 <= self.mass_kg < 1e4:
            raise InputError(f"a mass of {self.mass_kg} kg", expected="0 or more")
        x, y, z = frame.com if self.com_mm is None else (from_mm(v) for v in self.com_mm)
        mass = frame.mass if self.mass_kg is None else self.mass_kg
        text = exchange_format(self.to).write(ToolFrame(self.name or frame.name, frame.pose, mass, (x, y, z)))
        if self.out is None:
            print(text, end="")
            return 0
        try:
            self.out.write_text(text, encoding="utf-8")
        except OSError as error:
            raise FileFormatError(f"cannot be written ({error.strerror})", file=self.out) from None
        return 0
