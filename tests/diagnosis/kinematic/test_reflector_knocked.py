"""One reflector of several knocked in mid-run: told as that one, with its row and by how much, and nothing else."""

import numpy as np
import pytest

from app.diagnosis.judging import WITH, judge
from app.diagnosis.kinematic.diagnose import diagnose
from app.diagnosis.model import model_of
from tests.diagnosis.kinematic.simulating import NOISE_MM, poses, term, tracker_rows, write_tracker

REFLECTORS = np.array([[0.05, -0.03, 0.2], [0.0, 0.12, 0.15], [-0.1, -0.05, 0.18]])
KNOCK = np.array([0.9e-3, -0.4e-3, 0.6e-3])  # m, in the flange


def _recorded(arm, folder, seed, knocked=(), terms=(), rows=60):
    """Three reflectors; `knocked` of them (from 0) sit elsewhere from row 35 (1-based) on."""
    rng = np.random.default_rng([91, seed])
    q = poses(arm, rng, rows)
    points = tracker_rows(arm, q, terms, rng=rng, noise=0.0, reflectors=REFLECTORS)
    moved = REFLECTORS.copy()
    moved[list(knocked)] += KNOCK
    points[34:] = tracker_rows(arm, q, terms, rng=rng, noise=0.0, reflectors=moved)[34:]
    return write_tracker(folder / "three.csv", arm, q, points + rng.normal(0, NOISE_MM * 1e-3, points.shape))


@pytest.mark.parametrize("which", [0, 1, 2])
def test_it_is_that_reflector_from_that_row(arm, tmp_path, which):
    table = _recorded(arm, tmp_path, which, (which,))
    found = diagnose(table, arm)
    assert [(f.effect, f.where["reflector"]) for f in found.findings] == [("tool_slip", which + 1)]
    finding = found.findings[0]
    assert found.verdict == "named" and finding.where["from_row"] == 35
    for parameter, true in zip(finding.parameters, KNOCK, strict=True):
        assert abs(parameter.value - true * 1e3) < 4.0 * parameter.std
    assert found.after.heldout_rms < 1.25 * NOISE_MM
    assert f"reflector {which + 1}" in finding.sentence


def test_all_of_them_are_the_tool(arm, tmp_path):
    found = diagnose(_recorded(arm, tmp_path, 5, (0, 1, 2)), arm)
    assert [f.effect for f in found.findings] == ["tool_slip"]
    assert "reflector" not in found.findings[0].where


def test_an_arms_own_fault_is_told_beside_it(arm, tmp_path):
    hidden = (term("joint_zero", {"joint": 3}, 4e-3),)
    found = diagnose(_recorded(arm, tmp_path, 6, (1,), hidden), arm)
    assert {(f.effect, f.where.get("joint"), f.where.get("reflector")) for f in found.findings} == {
        ("tool_slip", None, 2),
        ("joint_zero", 3, None),
    }


def test_the_saved_model_gives_what_was_said(arm, tmp_path):
    table = _recorded(arm, tmp_path, 8, (2,))
    found = diagnose(table, arm)
    again = judge(table, arm, model_of(found)).steps[WITH]
    assert again.fit_rms == pytest.approx(found.after.fit_rms, rel=0.01)
