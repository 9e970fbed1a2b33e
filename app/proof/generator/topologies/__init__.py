"""Families of arms: one file a family, each with a `TOPOLOGY` that draws a member."""
