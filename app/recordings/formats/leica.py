"""Point lists of Leica tracker programs (Tracker Pilot, Axyz, emScon clients): `Point ID; X; Y; Z; …` with a header.

What stands in the columns is chosen by whoever exports, so the header row is read: a column `Point ID` (or
`PointID`, `Pt. ID`, `Punkt-ID`, `Punktnummer`), then `X`, `Y`, `Z` with the unit in brackets or in a line of its own.
Semicolons with decimal commas (as a German Windows writes), commas and tabs.
"""

from __future__ import annotations

from pathlib import Path

from app.recordings.point_lists import headed, header_line, own_header, read_text
from app.recordings.table import Table

NAMES = frozenset({"pointid", "ptid", "ptnr", "punktid", "punktnr", "punktnummer", "pointnumber"})


class Leica:
    key = "leica"
    title = "Leica tracker points"

    def matches(self, path: Path, head: bytes) -> bool:
        """A header row with a point id beside X and Y."""
        if not path.is_file() or b"\x00" in head or head.lstrip().startswith((b"#", b"//")):
            return False
        lines = head.decode("utf-8-sig", errors="replace").splitlines()
        found = header_line(lines, NAMES)
        return found is not None and not own_header(lines[found[0]])

    def read(self, path: Path) -> Table:
        """Reads all of it.

        Raises:
            FileFormatError, MissingColumnError, CellValueError: by row and column.
        """
        return headed(path, read_text(path), NAMES, self.title)


FORMAT = Leica()
