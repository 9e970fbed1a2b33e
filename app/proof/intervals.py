"""How sure a rate is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

Z = 1.959963984540054  # 95%, two-sided


@dataclass(frozen=True)
class Rate:
    """`hits` of `cases`, with Wilson's interval.

    Source: Wilson (1927), score interval.
    """

    hits: int
    cases: int

    @property
    def value(self) -> float | None:
        return self.hits / self.cases if self.cases else None

    @property
    def interval(self) -> tuple[float, float]:
        """95%; (0, 1) where there is no case."""
        n = self.cases
        if n == 0:
            return 0.0, 1.0
        p, z2 = self.hits / n, Z * Z
        centre = (p + z2 / (2 * n)) / (1 + z2 / n)
        half = Z / (1 + z2 / n) * float(np.sqrt(p * (1 - p) / n + z2 / (4 * n * n)))
        # at the ends the formula gives 0 and 1 but for rounding
        low = 0.0 if self.hits == 0 else max(0.0, centre - half)
        high = 1.0 if self.hits == n else min(1.0, centre + half)
        return low, high
