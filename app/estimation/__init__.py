"""What was fitted and how well: parameters, least squares, covariance, rank.

fit.py            Fit: the frozen result with `summary()`
linear.py         linear least squares through the singular value decomposition
gauss_newton.py   non-linear least squares with analytic Jacobians
"""

from app.estimation.fit import Fit
from app.estimation.gauss_newton import gauss_newton
from app.estimation.linear import solve_linear

__all__ = ["Fit", "gauss_newton", "solve_linear"]
