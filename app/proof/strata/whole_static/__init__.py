"""Strata of arms that are off everywhere, recorded twice by touches, tracker or draw-wire."""
