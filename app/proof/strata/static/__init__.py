"""Strata of touches and tracker recordings."""
