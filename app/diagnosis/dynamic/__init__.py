"""Joint logs from the table to the diagnosis."""
