"""A load on another link than the last is told from that link being heavier itself."""

from __future__ import annotations

import msgspec
import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.dynamic.judging import judged
from app.diagnosis.model import SavedModel
from app.kinematics import load_robot
from app.kinematics.dynamics import inertial_parameters, point_mass
from app.kinematics.regressor import torque_regressor
from tests.diagnosis.dynamic.simulator import measure, swing, write

SIGMAS = 4.5
MASS = 3.0
PLACES = {3: [0.1, 0.25, 0.12], 5: [0.06, -0.1, 0.08]}  # m in the link's frame
OPEN = {2: [0.2, 0.15, 0.1]}  # whose moment shows and whose weight does not: joint 1 turns about the vertical


def _add(run, link: int, change: np.ndarray) -> None:
    """Torque of a change (10,) of a link's inertial parameters; links before it carry it too."""
    part = torque_regressor(run.robot, run.q, run.qd, run.qdd)[:, :, 10 * (link - 1) : 10 * link]
    run.torque += part @ change


def _table(path, seed, *, load=None, heavier=None, friction=0.0):
    robot, rng = load_robot("ur10e"), np.random.default_rng(seed)
    run = swing(robot, rng, samples=2000)
    if load is not None:
        _add(run, load, point_mass(MASS, np.array((PLACES | OPEN)[load])))
    if heavier is not None:
        _add(run, heavier, 0.4 * inertial_parameters(robot)[10 * (heavier - 1) : 10 * heavier])
    run.torque += friction * np.array([6, 6, 4, 1, 1, 1]) * np.sign(run.qd)
    measure(run, rng, 0.02)
    return write(run, path, digits=7), robot


def _the_load(found, link: int):
    (finding,) = [f for f in found.findings if f.effect == "payload"]
    assert finding.where == {"link": link}
    values = {p.name: p for p in finding.parameters}
    for name, value in zip(("mass", "com_x", "com_y", "com_z"), (MASS, *PLACES[link]), strict=True):
        assert abs(values[name].value - value) < SIGMAS * values[name].std
    return finding


@pytest.mark.parametrize("link", sorted(PLACES))
def test_a_load_on_a_link_is_weighed_and_the_links_own_masses_are_listed_with_it(tmp_path, link):
    table, robot = _table(tmp_path / "log.csv", 81, load=link)
    found = diagnose(table, robot)
    finding = _the_load(found, link)
    assert len(found.findings) == 1 and f"link {link}" in finding.sentence
    assert next((a.effect, dict(a.where)) for a in finding.alternatives) == ("link_inertia", {"link": link})
    assert [f.family for f in found.families] == ["load"]
    model = msgspec.convert(dict(found.model), SavedModel)
    before, after = judged(table, robot, model).qualities
    assert (
        after.fit_rms == pytest.approx(found.after.fit_rms, rel=1e-3) and after.fit_rms < 0.5 * before.fit_rms
    )


def test_a_link_that_is_heavier_itself_is_no_load(tmp_path):
    table, robot = _table(tmp_path / "log.csv", 82, heavier=3)
    (finding,) = diagnose(table, robot).findings
    assert (finding.effect, finding.where["link"]) == ("link_inertia", 3)


@pytest.mark.parametrize("link", sorted(PLACES))
def test_what_a_link_carries_since_the_reference_is_a_load(tmp_path, link):
    table, robot = _table(tmp_path / "loaded.csv", 83, load=link, friction=1.0)
    before, _ = _table(tmp_path / "bare.csv", 84, friction=1.0)
    found = diagnose(table, robot, reference=before)
    finding = _the_load(found, link)
    assert len(found.findings) == 1 and not finding.alternatives


def test_a_load_whose_weight_no_motion_shows_is_not_silent(tmp_path):
    """It was said to be clean: the change is beyond doubt, the weight is open, and its interval says so."""
    table, robot = _table(tmp_path / "loaded.csv", 85, load=2, friction=1.0)
    before, _ = _table(tmp_path / "bare.csv", 86, friction=1.0)
    found = diagnose(table, robot, reference=before)
    (finding,) = found.findings
    assert (finding.effect, finding.where) == ("payload", {"link": 2})
    mass = finding.parameters[0]
    assert mass.value > 0 and abs(mass.value - MASS) < 2.0 * mass.std and mass.std > 0.2 * MASS
    assert finding.heldout_rms_without > 1.2 * finding.heldout_rms_with
