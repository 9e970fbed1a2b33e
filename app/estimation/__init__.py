"""What was fitted and how well: parameters, least squares, covariance, rank.

fit.py            Fit: the frozen result with `summary()`
linear.py         linear least squares through the singular value decomposition
gauss_newton.py   non-linear least squares with analytic Jacobians
certainty.py      how many standard errors a 95% region reaches, and a value with its 95% as a person reads it
"""

from app.estimation.certainty import HALF, LEVEL, plus_minus, reach
from app.estimation.fit import Fit
from app.estimation.gauss_newton import gauss_newton
from app.estimation.linear import solve_linear

__all__ = ["HALF", "LEVEL", "Fit", "gauss_newton", "plus_minus", "reach", "solve_linear"]
