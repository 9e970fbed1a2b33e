"""A person at a session; see tests/desk.py."""

from tests.desk import brisk, desk, in_the_cell, patient, sit_at  # noqa: F401
