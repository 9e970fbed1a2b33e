"""A person at a session; see tests/desk.py."""

from tests.desk import brisk, desk, patient, sit_at  # noqa: F401
