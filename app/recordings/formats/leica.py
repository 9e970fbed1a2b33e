"""Point lists of Leica tracker programs (Tracker Pilot, Axyz, emScon clients): `Point ID; X; Y; Z; …` with a header.

What stands in the columns is chosen by whoever exports, so the header row is read: a column `Point ID` (or
`PointID`, `Pt. ID`, `Punkt-ID`, `Punktnummer`), then `X`, `Y`, `Z` with the unit in brackets or in a line of its own.
Semicolons with decimal commas (as a German Windows writes), commas and tabs.
"""

from __future__ import annotations

from app.recordings.point_lists import HeadedList

NAMES = frozenset({"pointid", "ptid", "ptnr", "punktid", "punktnr", "punktnummer", "pointnumber"})

FORMAT = HeadedList("leica", "Leica tracker points", NAMES)
