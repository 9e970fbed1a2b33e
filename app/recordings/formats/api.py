"""Point lists of API tracker programs (Radian, OT2, SpatialMaster): `Point Name, X (mm), Y (mm), …` with a header.

The header row is read as it is: a column `Point Name` (or `Name`, `Target`, `Label`), then `X`, `Y`, `Z` with the unit
in brackets or in a line of its own; any preface of instrument, date and weather is passed over.
"""

from __future__ import annotations

from app.recordings.point_lists import HeadedList

NAMES = frozenset({"pointname", "name", "target", "targetname", "label", "point"})

FORMAT = HeadedList("api", "API tracker points", NAMES)
