"""What was fitted and how well: parameters, least squares, covariance, rank.

fit.py            Fit: the frozen result with `summary()`
linear.py         linear least squares through the singular value decomposition
lowest.py         the lowest point of a function of one number
gauss_newton.py   non-linear least squares with analytic Jacobians
"""

from app.estimation.fit import Fit
from app.estimation.gauss_newton import gauss_newton
from app.estimation.linear import solve_linear
from app.estimation.lowest import lowest

__all__ = ["Fit", "gauss_newton", "lowest", "solve_linear"]
