"""Joint logs over time."""
