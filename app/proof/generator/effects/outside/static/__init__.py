"""Deviations of a tool point that follow no law of the library, on purpose."""
