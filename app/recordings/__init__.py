"""What was recorded: tables whose columns carry units, read once and frozen.

columns.py   names of columns -> quantity, number, unit
table.py     Table: header keys and columns in SI units, errors that name the cell
reading.py   picks the format and reads
formats/     one file a format
"""

from app.recordings.reading import read_table
from app.recordings.table import Table

__all__ = ["Table", "read_table"]
