"""Torques that follow no law of the library, on purpose."""
