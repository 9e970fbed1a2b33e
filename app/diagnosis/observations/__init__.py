"""Recordings as arrays in SI units: rows that cannot be used are set aside and counted, never repaired."""
