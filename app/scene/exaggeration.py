"""Round factors by which small things are drawn larger, so that they can be seen; always said beside the drawing."""

from __future__ import annotations

_FACTORS = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1_000, 2_000, 5_000, 10_000)


def factor_for(size: float, longest: float) -> int:
    """The largest round factor that keeps `size` within `longest` (same unit); 1 where even that is too much."""
    fits = [factor for factor in _FACTORS if factor * size <= longest]
    return fits[-1] if fits else 1
