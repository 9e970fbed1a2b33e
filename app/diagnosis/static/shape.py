"""Before a name is given: does the residual follow the named law along its driver, or only something like it?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.diagnosis.static.curves import shape_functions
from app.diagnosis.static.effect import without_row
from app.diagnosis.static.fit import Fitted, Term
from app.diagnosis.static.looking import without
from app.diagnosis.static.score import basis, significance

#: Chance at which a free curve of the same driver may beat the law before the name is withheld.
LEVEL = 0.002
#: What a free curve may add, as a share of what the law itself explains, before the name is withheld. A law that
#: explains twenty times as much as any curve could add to it is the right name: what the curve picks up then is
#: other structure of the arm, however certain that structure is.
SHARE = 0.05


def curve_p_value(fitted: Fitted, index: int) -> float:
    """Chance that a free curve of the same driver would do so much better than the law of term `index`."""
    extra = _extra_columns(fitted, fitted.terms[index])
    if extra is None:
        return 1.0
    extra = _padded(fitted, extra)
    base = basis(fitted.jacobian)
    projected = base.project(extra)
    scale = np.sqrt(np.einsum("nd,nd->d", extra, extra))
    seen = scale > 0
    if not seen.any():
        return 1.0
    own = basis_of_visible(projected[:, seen] / scale[seen])
    if own.shape[1] == 0:
        return 1.0
    rest = fitted.white - base.q @ (base.q.T @ fitted.white)
    gain = float(np.sum((own.T @ rest) ** 2))
    if gain < SHARE * law_gain(fitted, index):
        return 1.0
    dof = max(fitted.size - base.q.shape[1], 2)
    return float(10.0 ** -significance(np.array(gain), float(rest @ rest), own.shape[1], dof))


def law_gain(fitted: Fitted, index: int) -> float:
    """What term `index` takes off the sum of squares, everything else refitted."""
    jacobian, white = without(fitted, index)
    base = basis(jacobian)
    own = basis(base.project(fitted.jacobian[:, fitted.slices[index]]))
    rest = white - base.q @ (base.q.T @ white)
    return float(np.sum((own.q.T @ rest) ** 2))


def dominant(fitted: Fitted, indices: list[int], share: float = SHARE) -> bool:
    """True where one of these terms by itself explains all but a share of what they explain together.

    Such a law stands, whatever company it keeps: what the others pick up is too little to put its name in doubt.
    """
    jacobian, white = without(fitted, *indices)
    base = basis(jacobian)
    rest = white - base.q @ (base.q.T @ white)
    blocks = [base.project(fitted.jacobian[:, fitted.slices[index]]) for index in indices]
    gains = [float(np.sum((basis(block).q.T @ rest) ** 2)) for block in blocks]
    together = float(np.sum((basis(np.concatenate(blocks, axis=1)).q.T @ rest) ** 2))
    return max(gains) > (1.0 - share) * together


def basis_of_visible(projected: np.ndarray, least: float = 0.03) -> np.ndarray:
    """Orthonormal basis of what is left of unit columns, directions that have all but vanished dropped."""
    u, s, _ = np.linalg.svd(projected, full_matrices=False)
    return u[:, s > least]


def _padded(fitted: Fitted, extra: np.ndarray) -> np.ndarray:
    return np.concatenate([extra, np.zeros((len(fitted.white) - len(extra), extra.shape[1]))])


def _extra_columns(fitted: Fitted, term: Term) -> np.ndarray | None:
    """(N, d) whitened columns of the free curve, or None where the law has no driver."""
    columns, situation = fitted.columns, fitted.recording.situation
    n = fitted.weights.size
    if "from_row" in term.where:  # a step: could it be a slow change instead?
        times = smooth_sides(situation.order, int(term.where["from_row"]))
        block = term.effect.columns(columns, _started(term))
        return (block[:, :, :, None] * times[:, None, None, :]).reshape(n, -1)
    curve = term.effect.curve
    if curve is None:
        return None
    functions = shape_functions(situation, term.where, curve)
    if "joint" in term.where:
        joint = columns.joint[:, :, int(term.where["joint"]) - 1]
        return (joint[:, :, None] * functions[:, None, :]).reshape(n, -1)
    block = term.effect.columns(columns, term.place)
    driver = situation.temperature if term.where.get("driver") == "temperature" else situation.time
    assert driver is not None
    slope = np.where(np.abs(driver) > 0, driver, 1.0)
    rate = np.where(np.abs(driver)[:, None] > 0, functions / slope[:, None], 0.0)  # its own driver taken out
    return (block[:, :, :, None] * rate[:, None, None, :]).reshape(n, -1)


def _started(term: Term):
    where = without_row(term.where)
    return replace(term.place, where=where)


def smooth_sides(order: np.ndarray, row: int) -> np.ndarray:
    """(m, 2) slopes before and after the step."""
    after = (order >= row).astype(float)
    u = (order - row) / max(float(np.ptp(order)), 1.0)
    return np.column_stack([u * after, u * (1.0 - after)])
