"""Every effect: its exact law and its linear columns say the same, and alone in a recording it is found."""

import numpy as np
import pytest

from app.diagnosis.kinematic.diagnose import diagnose
from app.diagnosis.kinematic.plain import plain_state
from app.diagnosis.models.kinematic.candidates import library_of
from app.diagnosis.models.kinematic.state import columns_of, free_columns, state_of
from app.diagnosis.models.kinematic.terms import Term, effects
from app.diagnosis.observations.pose_reading import read_static
from app.diagnosis.regression.design import Design
from tests.diagnosis.kinematic.simulating import poses, term, tracker_rows, write_tracker

STEP = 1e-6
#: Largest difference of a column from its finite difference, relative to the column's size.
COLUMN_TOLERANCE = 2e-4
#: Standard deviations an estimate may lie from the truth.
SIGMAS = 4.5

LINEAR = sorted(set(effects()) - {"wrong_convention", "delay"})

#: One example an effect: where, values in SI, form. Sizes of one or two millimetres at the tool.
EXAMPLES = {
    "joint_zero": ({"joint": 3}, [1.5e-3], {}),
    "link_length": ({"link": 2, "axis": "a"}, [1.2e-3], {}),
    "link_twist": ({"link": 3, "axis": "alpha"}, [2e-3], {}),
    "joint_compliance": ({"joint": 2, "driver": "gravity_torque"}, [3e-5], {}),
    "backlash": ({"joint": 3, "driver": "approach"}, [4e-3], {}),
    "gear_eccentricity": ({"joint": 2, "driver": "own_angle", "order": 2}, [2e-3, -1.5e-3], {}),
    "gear_ratio": ({"joint": 3, "driver": "own_angle"}, [1.5e-3], {}),
    "joint_coupling": ({"joint": 5, "source_joint": 4}, [4e-3], {}),
    "thermal_growth": ({"link": 2, "driver": "time"}, [2e-6], {}),
    "joint_drift": ({"joint": 2, "driver": "time"}, [6e-7], {}),
    "base_drift": ({"body": "base", "driver": "time"}, [5e-7, -3e-7, 2e-7], {"turning": 0.0}),
    "base_shift": ({"body": "base", "from_row": 33}, [1e-3, 0.0, -8e-4], {"turning": 0.0}),
    "tool_slip": ({"body": "tool", "from_row": 25}, [1e-3, 0.0, 9e-4], {}),
    "joint_slip": ({"joint": 3, "from_row": 30}, [2e-3], {}),
    "early_reading": ({"body": "instrument", "driver": "approach"}, [1.5e-3], {}),
    "instrument_scale": ({"body": "instrument"}, [1.5e-3], {}),
    "instrument_zero_shift": ({"body": "instrument"}, [5e-3], {}),
}


@pytest.fixture(scope="module")
def plain(arm, tmp_path_factory):
    rng = np.random.default_rng(5)
    q = poses(arm, rng, 40)
    points = tracker_rows(arm, q, rng=rng, reflectors=([0.05, -0.03, 0.2], [0.0, 0.1, 0.15]))
    keys = ["# compliance_rad_per_Nm: [1e-5, 2e-5, 2e-5, 5e-5, 5e-5, 5e-5]"]
    extra = {"temperature_degC": 20.0 + 4.0 * np.linspace(0, 1, 40) ** 2}
    path = tmp_path_factory.mktemp("plain") / "plain.csv"
    table = write_tracker(path, arm, q, points, keys=keys, extra=extra)
    return plain_state(read_static(table, arm), ())[0]


@pytest.fixture(scope="module")
def displaced(plain):
    """The same with its base far away and turned by 29 degrees from row 15 on."""
    away = term(
        "base_shift", {"body": "base", "from_row": 15}, [0.3, -0.4, 0.2, 0.3, 0.2, -0.35], turning=1.0
    )
    return state_of(plain.recording, plain.setup, (), plain.weights, held=(away,))


@pytest.mark.parametrize("key", LINEAR)
def test_columns_are_the_slope_of_the_exact_law(plain, key):
    _compare(plain, key)


@pytest.mark.parametrize("key", [key for key in LINEAR if not key.startswith(("base", "unnamed"))])
def test_columns_are_the_slope_where_the_base_is_far_from_where_it_was(displaced, key):
    """The base's own turns are left out: there columns are turns about the base's axes, the law's numbers are not."""
    _compare(displaced, key)


def test_columns_of_an_arm_that_moves_are_the_slope_of_the_exact_law(arm, tmp_path):
    rng = np.random.default_rng(5)
    q, seconds = poses(arm, rng, 40), 0.05 * np.arange(40)
    table = write_tracker(tmp_path / "on.csv", arm, q, tracker_rows(arm, q, rng=rng), seconds=seconds)
    _compare(plain_state(read_static(table, arm), ())[0], "delay")


def _compare(plain, key):
    situation = plain.recording.situation
    seen = 0
    library, sensitivity = library_of(situation), columns_of(plain)
    for candidate in (*library.fixed, *library.scanned):
        if candidate.effect.key != key:
            continue
        seen += 1
        place = candidate.place.at(from_row=20) if candidate.place.scan else candidate.place
        count = len(candidate.effect.quantities(situation, place))
        columns = candidate.effect.columns(sensitivity, place)
        assert columns.shape[2] == count
        for d in range(count):
            values = np.zeros(count)
            values[d] = STEP
            ahead = _white(plain, Term(candidate.effect, place, values))
            behind = _white(plain, Term(candidate.effect, place, -values))
            slope = (behind - ahead) / (2 * STEP)  # the residual falls as the prediction rises
            size = np.abs(columns[:, :, d]).max()
            assert np.abs(slope - columns[:, :, d]).max() <= COLUMN_TOLERANCE * max(size, 1.0), place
    assert seen


def _white(plain, single):
    now = state_of(plain.recording, plain.setup, (single,), plain.weights, held=plain.held)
    return now.residual * plain.weights


@pytest.mark.parametrize("key", sorted(EXAMPLES))
def test_an_effect_alone_is_found_named_and_measured(arm, tmp_path, key):
    where, values, fixed = EXAMPLES[key]
    rng = np.random.default_rng([8, sorted(EXAMPLES).index(key)])
    q = poses(arm, rng, 60)
    hidden = term(key, where, values, **fixed)
    table = write_tracker(tmp_path / "r.csv", arm, q, tracker_rows(arm, q, (hidden,), rng=rng))
    found = diagnose(table, arm)
    assert [f.effect for f in found.findings] == [key]
    said = dict(found.findings[0].where)
    assert abs(said.pop("from_row", 0) - where.get("from_row", 0)) <= 1
    assert said == {k: v for k, v in where.items() if k != "from_row"}
    situation = read_static(table, arm).situation
    true = hidden.effect.report(situation, hidden.place, hidden.values, np.eye(len(values)))
    for estimate, truth in zip(found.findings[0].parameters, true, strict=True):
        assert estimate.unit == truth.unit
        assert abs(estimate.value - truth.value) <= SIGMAS * estimate.std
    assert found.verdict == "named"
    assert found.after.heldout_rms < 0.5 * found.before.heldout_rms


def test_every_effect_of_the_contract_is_there():
    assert set(effects()) >= {*EXAMPLES, "payload", "touch_indentation", "wrong_convention"}


def test_a_payload_is_felt_through_declared_compliance(arm, tmp_path):
    rng = np.random.default_rng(31)
    q = poses(arm, rng, 60)
    keys = ["# compliance_rad_per_Nm: [1e-5, 3e-5, 3e-5, 5e-5, 5e-5, 5e-5]"]
    table = write_tracker(tmp_path / "a.csv", arm, q, tracker_rows(arm, q, rng=rng), keys=keys)
    situation = read_static(table, arm).situation
    mass = 6.0
    sag = {j + 1: -situation.declared_compliance[j] * mass * situation.moment[:, j, 0] for j in range(6)}
    points = tracker_rows(arm, q, rng=rng, distort=lambda _: sag)
    found = diagnose(write_tracker(tmp_path / "b.csv", arm, q, points, keys=keys), arm)
    assert found.findings[0].effect == "payload"
    parameter = found.findings[0].parameters[0]
    assert (parameter.name, parameter.unit) == ("mass", "kg")
    assert abs(parameter.value - mass) <= SIGMAS * parameter.std


def test_a_pressed_tip_cannot_be_told_from_a_longer_tool(plain):
    effect = effects()["touch_indentation"]
    columns = columns_of(plain)
    block = effect.columns(columns, next(iter(effect.places(plain.recording.situation)))).reshape(-1, 1)
    # Both reflectors move alike along flange Z: exactly what the tools' own parameters do.
    free, absorbed = free_columns(plain, columns)
    design = Design(plain.white, free, plain.weights.size, absorbed)
    assert np.linalg.norm(design.explicit(design.add(block))) < 1e-6 * np.linalg.norm(block)
