"""One law that no library holds is not given the names of two that happen to add up to it; early readings are named."""

import numpy as np
import pytest

from app.diagnosis.kinematic.diagnose import diagnose
from tests.diagnosis.kinematic.simulating import poses, term, tracker_rows, write_tracker

ROWS = 90


def _recorded(arm, folder, seed, terms=(), distort=None):
    rng = np.random.default_rng(seed)
    q = poses(arm, rng, ROWS)
    return write_tracker(folder / "r.csv", arm, q, tracker_rows(arm, q, terms, rng=rng, distort=distort))


def _product(situation):
    middle = situation.q - 0.5 * (situation.q.max(axis=0) + situation.q.min(axis=0))
    return {4: 4e-3 * middle[:, 3] * middle[:, 4]}


def _trailing(situation):
    q = situation.q[:, 2]
    width, place = 0.3 * np.ptp(q), q.copy()
    for i in range(1, len(q)):
        place[i] = np.clip(place[i - 1], q[i] - width, q[i] + width)
    return {3: 3e-3 * (place - q)}


@pytest.mark.parametrize("law", [_product, _trailing], ids=["two joints at once", "play that remembers"])
@pytest.mark.parametrize("seed", range(3))
def test_a_law_that_no_library_holds_is_never_named_outright(arm, tmp_path, law, seed):
    found = diagnose(_recorded(arm, tmp_path, [911, seed], distort=law), arm)
    assert found.verdict in ("unexplained", "partly")


def test_two_true_effects_on_one_joint_keep_their_names(arm, tmp_path):
    hidden = (
        term("gear_ratio", {"joint": 3, "driver": "own_angle"}, 2e-3),
        term("backlash", {"joint": 3, "driver": "approach"}, 3e-3),
    )
    found = diagnose(_recorded(arm, tmp_path, 922, hidden), arm)
    assert found.verdict == "named"
    assert {f.effect for f in found.findings} == {"gear_ratio", "backlash"}


def test_angles_that_were_read_before_the_arm_stopped_are_named(arm, tmp_path):
    hidden = term("early_reading", {"body": "instrument", "driver": "approach"}, 4e-4)
    found = diagnose(_recorded(arm, tmp_path, 933, (hidden,)), arm)
    assert [f.effect for f in found.findings] == ["early_reading"]
    share = found.findings[0].parameters[0]
    assert abs(share.value - 4e-4) < 4.0 * share.std
