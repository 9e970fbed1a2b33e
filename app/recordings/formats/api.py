"""Point lists of API tracker programs (Radian, OT2, SpatialMaster): `Point Name, X (mm), Y (mm), …` with a header.

The header row is read as it is: a column `Point Name` (or `Name`, `Target`, `Label`), then `X`, `Y`, `Z` with the unit
in brackets or in a line of its own; any preface of instrument, date and weather is passed over.
"""

from __future__ import annotations

from pathlib import Path

from app.recordings.point_lists import headed, header_line, own_header, read_text
from app.recordings.table import Table

NAMES = frozenset({"pointname", "name", "target", "targetname", "label", "point"})


class Api:
    key = "api"
    title = "API tracker points"

    def matches(self, path: Path, head: bytes) -> bool:
        """A header row with a point's name beside X and Y."""
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


FORMAT = Api()
