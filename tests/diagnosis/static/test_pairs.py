"""All pairs at once, by inner products, against fitting every pair."""

import numpy as np

from app.diagnosis.static.fit import fit
from app.diagnosis.static.library import candidates
from app.diagnosis.static.looking import new_term, without
from app.diagnosis.static.pairs import rival_pairs
from app.diagnosis.static.plain import plain_fit
from app.diagnosis.static.reading import read_static
from tests.diagnosis.static.simulating import poses, term, tracker_rows, write_tracker

SAME = 1e-6  # of a BIC


def test_the_best_pair_is_the_best_of_all_pairs_fitted_one_by_one(arm, tmp_path):
    rng = np.random.default_rng(5)
    q = poses(arm, rng, 40)
    hidden = (
        term("joint_zero", {"joint": 3}, 1.5e-3),
        term("gear_ratio", {"joint": 2, "driver": "own_angle"}, 1e-3),
    )
    table = write_tracker(tmp_path / "r.csv", arm, q, tracker_rows(arm, q, hidden, rng=rng))
    plain = plain_fit(read_static(table, arm), ())
    wanted = tuple(
        c
        for c in candidates(plain.recording.situation)
        if c.effect.key in ("joint_zero", "gear_ratio", "gear_eccentricity")
    )
    wrong = [c for c in wanted if c.effect.key == "joint_zero" and c.place.where["joint"] in (4, 5)]
    terms = tuple(new_term(c, plain) for c in wrong)
    now = fit(plain.recording, plain.setup, terms, plain.weights)
    best = rival_pairs(now, (0, 1), wanted)[0]
    assert {(c.effect.key, c.place.where["joint"]) for c in (best.first, best.second)} == {
        ("joint_zero", 3),
        ("gear_ratio", 2),
    }
    jacobian, white = without(now, 0, 1)
    blocks = [
        c.effect.columns(now.columns, c.place).reshape(len(white), -1) for c in (best.first, best.second)
    ]
    both = np.column_stack([jacobian, *blocks])
    rest = white - both @ np.linalg.lstsq(both, white, rcond=None)[0]
    n = now.size
    assert abs(n * np.log(float(rest @ rest) / now.rss) - best.delta) < SAME
