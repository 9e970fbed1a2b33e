"""The lowest point of a function of one number between two bounds.

Source: Brent (1973), Algorithms for Minimization without Derivatives, ch. 5: parabolas through the three best points,
golden sections where a parabola leads nowhere.
"""

from __future__ import annotations

import math
from collections.abc import Callable

_GOLDEN = 0.5 * (3.0 - math.sqrt(5.0))
_ROUNDING = math.sqrt(2.2e-16)


def lowest(function: Callable[[float], float], low: float, high: float, *, within: float, most: int) -> float:
    """Where `function` is lowest in [low, high], if it has one minimum there.

    Args:
        within: how near is near enough.
        most: calls of `function`.
    """
    best = second = third = low + _GOLDEN * (high - low)
    at_best = at_second = at_third = function(best)
    step = before = 0.0
    for _ in range(most - 1):
        middle = 0.5 * (low + high)
        least = _ROUNDING * abs(best) + within / 3.0
        if abs(best - middle) <= 2.0 * least - 0.5 * (high - low):
            break
        bend, bend_before = None, before
        if abs(before) > least:
            r = (best - second) * (at_best - at_third)
            q = (best - third) * (at_best - at_second)
            p = (best - third) * q - (best - second) * r
            q = 2.0 * (q - r)
            p, q = (-p, q) if q > 0.0 else (p, -q)
            before = step
            if abs(p) < abs(0.5 * q * bend_before) and q * (low - best) < p < q * (high - best):
                bend = p / q
        if bend is None:
            before = (low if best >= middle else high) - best
            step = _GOLDEN * before
        else:
            near = min(best + bend - low, high - best - bend) < 2.0 * least  # of an end
            step = math.copysign(least, middle - best) if near else bend
        tried = best + math.copysign(max(abs(step), least), step)
        found = function(tried)
        if found <= at_best:
            low, high = (best, high) if tried >= best else (low, best)
            third, at_third, second, at_second = second, at_second, best, at_best
            best, at_best = tried, found
            continue
        low, high = (tried, high) if tried < best else (low, tried)
        if found <= at_second or second == best:
            third, at_third, second, at_second = second, at_second, tried, found
        elif found <= at_third or third in (best, second):
            third, at_third = tried, found
    return best
