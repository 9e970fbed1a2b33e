"""Everything found, refitted together with the exact laws.

A law that is not linear is replaced by its slopes at the present values and its torque moved to the other
side (Gauss-Newton); all else stays in the Gram matrices.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.motion.scoring import Solution, solve
from app.diagnosis.motion.search import Term
from app.diagnosis.motion.system import Group, System

ITERATIONS = 10


@dataclass(frozen=True, eq=False)
class ExactFit:
    """The final model.

    Args:
        terms: their groups are linearised about `values`.
        values: per term, parameter -> value.
        covariances: per term, (k, k) in the order of the values, whitened noise of one.
        jacobians: per term, (k, size), d values / d unknowns.
        offset: (M, n) torque that was moved to the other side.
    """

    terms: list[Term]
    values: list[dict[str, float]]
    covariances: list[np.ndarray]
    jacobians: list[np.ndarray]
    solution: Solution
    offset: np.ndarray

    def spreads(self, index: int, widened: np.ndarray) -> np.ndarray:
        """(k,) standard deviations of a term's values, those of all unknowns (p,) being widened so much."""
        at = len(self.solution.theta) - sum(t.group.size for t in self.terms[index:])
        place = slice(at, at + self.terms[index].group.size)
        J = self.jacobians[index] * widened[place]
        variance = np.einsum("ij,jk,ik->i", J, self.solution.covariance[place, place], J)
        return np.sqrt(np.maximum(variance, 0.0))


def is_linear(group: Group) -> bool:
    """True where the law is linear in all its parameters."""
    return group.law is not None and not any(name in group.shape for name in group.law.shape_bounds)


def exact_fit(system: System, prior: np.ndarray, terms: list[Term]) -> ExactFit:
    """Refits all terms with their exact laws."""
    samples = system.samples
    moved = np.zeros_like(samples.y)
    solution = solve(system, [t.group for t in terms], prior)
    parts = _parts(solution, terms)
    shapes = [dict(t.group.shape) for t in terms]
    bent = [i for i, t in enumerate(terms) if not is_linear(t.group)]
    for _ in range(ITERATIONS if bent else 0):
        moved = np.zeros_like(samples.y)
        for i in bent:
            group, law = terms[i].group, terms[i].group.law
            assert law is not None
            linear = parts[i][: len(law.linear)]
            columns, rest = _linearised(group, shapes[i], linear, samples)
            if group.joint is None:
                moved += rest
            else:
                moved[:, group.joint] += rest
            fresh = replace(group, size=columns.shape[-1], shape=dict(shapes[i]), bent=True)
            terms = [*terms[:i], replace(terms[i], group=system.append(fresh, columns)), *terms[i + 1 :]]
        system.replace_response(samples.y - moved)
        solution = solve(system, [t.group for t in terms], prior)
        parts = _parts(solution, terms)
        change = 0.0
        for i in bent:
            law = terms[i].group.law
            assert law is not None
            bounded = [n for n in law.shape_bounds if n in shapes[i]]
            for name, step in zip(bounded, parts[i][len(law.linear) :], strict=False):
                old = shapes[i][name]
                shapes[i][name] = _held(law.key, name, old, float(step), law.shape_bounds[name])
                change = max(change, abs(shapes[i][name] - old) / max(abs(old), 1e-9))
        if change < 1e-4 and _ > 0:
            break
    values, covariances, jacobians, at = [], [], [], len(solution.theta) - sum(t.group.size for t in terms)
    for i, term in enumerate(terms):
        law = term.group.law
        assert law is not None
        place = slice(at, at + term.group.size)
        at += term.group.size
        linear = parts[i][: len(law.linear)]
        values.append(law.values(linear, shapes[i]))
        J = _jacobian(law, linear, shapes[i], term.group.size)
        jacobians.append(J)
        covariances.append(J @ solution.covariance[place, place] @ J.T)
    return ExactFit(terms, values, covariances, jacobians, solution, moved)


def _linearised(group: Group, shape, linear: np.ndarray, samples) -> tuple[np.ndarray, np.ndarray]:
    """Columns of the linear parameters and of small steps of the shape; torque that neither holds. Pooled."""
    law, state = group.law, samples.state
    assert law is not None
    columns = samples.pool(law.columns(state, group.where, shape))
    values = law.values(linear, shape)
    rest = samples.pool(law.apply(state, group.where, values)) - columns @ linear
    more = []
    for name in law.shape_bounds:
        if name in shape:
            step = 5e-4 * abs(shape[name]) + 1e-9
            up = law.columns(state, group.where, {**shape, name: shape[name] + step})
            down = law.columns(state, group.where, {**shape, name: shape[name] - step})
            more.append(samples.pool((up - down) @ linear) / (2 * step))
    return np.concatenate([columns, *(m[..., None] for m in more)], axis=-1), rest


def _jacobian(law, linear: np.ndarray, shape, size: int) -> np.ndarray:
    """d values / d unknowns (linear parameters, then steps of the shape)."""
    names = list(law.values(linear, shape))
    J = np.zeros((len(names), size))
    for k in range(len(linear)):
        step = np.zeros(len(linear))
        step[k] = 1e-5 * max(abs(linear[k]), 1e-3)
        up, down = law.values(linear + step, shape), law.values(linear - step, shape)
        J[:, k] = [(up[n] - down[n]) / (2 * step[k]) for n in names]
    for k, name in enumerate([n for n in law.shape_bounds if n in shape]):
        if len(linear) + k < size:
            J[names.index(name), len(linear) + k] = 1.0
    return J


def _parts(solution: Solution, terms: list[Term]) -> list[np.ndarray]:
    at = len(solution.theta) - sum(t.group.size for t in terms)
    out = []
    for term in terms:
        out.append(solution.theta[at : at + term.group.size])
        at += term.group.size
    return out


def _held(key: str, name: str, old: float, step: float, bounds: tuple[float, float]) -> float:
    """The shape's new value: inside its bounds, and no more than half of itself away."""
    most = (0.02 if key == "torque_ripple" else 0.5) * abs(old)
    return float(np.clip(old + np.clip(step, -most, most), *bounds))
