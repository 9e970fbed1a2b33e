"""Every way a whole log may be written down or its arm mounted: found, undone, and said with its value."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.errors import UnitError
from app.kinematics import load_robot
from app.kinematics.dynamics import inverse_dynamics
from tests.diagnosis.dynamic.simulator import Swing, measure, swing, write

GAINS = np.array([12.0, 11.0, 10.0, 9.5, 10.5, 9.0])  # Nm/A of the drives
FRICTION = np.array([6.0, 6.0, 4.0, 1.0, 1.0, 1.0])  # Nm, dry


@dataclass(frozen=True)
class Asked:
    """One convention.

    Args:
        change: does it to a run whose torques are measured already.
        effect, where: what must be found, and the parts of `where` that it must state.
        values: parameter -> (value, how far off it may be).
    """

    name: str
    change: Callable[[Swing], None]
    effect: str
    where: Mapping[str, Any] = field(default_factory=dict)
    values: Mapping[str, tuple[float, float]] = field(default_factory=dict)


def _mounted(*gravity: float) -> Callable[[Swing], None]:
    def change(run: Swing) -> None:
        upright = inverse_dynamics(run.robot, run.q, run.qd, run.qdd)
        run.torque += inverse_dynamics(run.robot, run.q, run.qd, run.qdd, gravity=np.array(gravity)) - upright

    return change


def _torque_sense(joint: int) -> Callable[[Swing], None]:
    def change(run: Swing) -> None:
        run.torque[:, joint - 1] *= -1.0

    return change


def _place_sense(joint: int) -> Callable[[Swing], None]:
    def change(run: Swing) -> None:
        run.q[:, joint - 1] *= -1.0

    return change


def _swapped(a: int, b: int, *names: str) -> Callable[[Swing], None]:
    def change(run: Swing) -> None:
        for name in names:
            values = getattr(run, name)
            values[:, [a - 1, b - 1]] = values[:, [b - 1, a - 1]]

    return change


def _all_torques(factor: float | np.ndarray) -> Callable[[Swing], None]:
    def change(run: Swing) -> None:
        run.torque *= factor

    return change


def _all_angles(factor: float) -> Callable[[Swing], None]:
    def change(run: Swing) -> None:
        run.q *= factor

    return change


def _one_angle(joint: int, factor: float) -> Callable[[Swing], None]:
    def change(run: Swing) -> None:
        run.q[:, joint - 1] *= factor

    return change


def _clock(factor: float) -> Callable[[Swing], None]:
    def change(run: Swing) -> None:
        run.t *= factor

    return change


def _gravity(*g: float) -> dict[str, tuple[float, float]]:
    return {name: (value, 0.1) for name, value in zip(("gx", "gy", "gz"), g, strict=True)}


DEGREES = 180.0 / np.pi
KIND = "wrong_convention"
ASKED = [
    Asked("on a wall", _mounted(9.81, 0, 0), "gravity_direction", {}, _gravity(9.81, 0, 0)),
    Asked("on a wall, sideways", _mounted(0, -9.81, 0), "gravity_direction", {}, _gravity(0, -9.81, 0)),
    Asked("on the ceiling", _mounted(0, 0, 9.81), "gravity_direction", {}, _gravity(0, 0, 9.81)),
    Asked("on a slope", _mounted(4.905, 0, -8.496), "gravity_direction", {}, _gravity(4.905, 0, -8.496)),
    Asked("no gravity in it", _mounted(0, 0, 0), KIND, {"kind": "no_gravity"}),
    Asked("all torques the other way", _all_torques(-1.0), KIND, {"kind": "torque_senses"}),
    Asked("one torque the other way", _torque_sense(3), KIND, {"kind": "torque_sense", "joint": 3}),
    Asked("one joint the other way", _place_sense(2), KIND, {"kind": "joint_sense", "joint": 2}),
    Asked(
        "two torques changed over",
        _swapped(2, 3, "torque"),
        KIND,
        {"kind": "torque_order", "joint": 2, "source_joint": 3},
    ),
    Asked(
        "two positions changed over",
        _swapped(2, 4, "q"),
        KIND,
        {"kind": "joint_order", "joint": 2, "source_joint": 4},
    ),
    Asked(
        "two joints changed over",
        _swapped(1, 3, "q", "torque"),
        KIND,
        {"kind": "joints_swapped", "joint": 1, "source_joint": 3},
    ),
    Asked(
        "radians as degrees",
        _all_angles(1.0 / DEGREES),
        KIND,
        {"kind": "angle_unit"},
        {"factor": (DEGREES, 1e-6)},
    ),
    Asked(
        "one joint in radians as degrees",
        _one_angle(3, 1.0 / DEGREES),
        KIND,
        {"kind": "angle_unit", "joint": 3},
        {"factor": (DEGREES, 1e-6)},
    ),
    Asked("a clock at half speed", _clock(0.5), KIND, {"kind": "clock"}, {"factor": (2.0, 1e-9)}),
    Asked("a clock at double speed", _clock(2.0), KIND, {"kind": "clock"}, {"factor": (0.5, 1e-9)}),
    Asked("one factor", _all_torques(1.3), "torque_constant", {}, {"scale": (0.3, 0.02)}),
    Asked("one factor of two", _all_torques(2.0), "torque_constant", {}, {"scale": (1.0, 0.03)}),
    Asked("millinewton-metres", _all_torques(1e3), "torque_constant", {}, {"scale": (999.0, 15.0)}),
]


def _case(tmp_path, change, *, seed=61, samples=1500):
    robot, rng = load_robot("ur10e"), np.random.default_rng(seed)
    run = swing(robot, rng, samples=samples)
    run.torque += FRICTION * np.sign(run.qd)
    measure(run, rng, 0.02)
    change(run)
    return diagnose(write(run, tmp_path / "log.csv", digits=8), robot)


@pytest.mark.parametrize("asked", ASKED, ids=lambda a: a.name)
def test_a_convention_of_a_whole_log_is_found_and_said_with_its_value(tmp_path, asked):
    found = _case(tmp_path, asked.change)
    told = [f for f in found.findings if f.effect in (KIND, "gravity_direction", "torque_constant")]
    assert [f.effect for f in told] == [asked.effect], [(f.effect, f.where) for f in told]
    (finding,) = told
    assert {k: finding.where.get(k) for k in asked.where} == dict(asked.where)
    if asked.effect == "torque_constant":
        assert "joint" not in finding.where
    values = {p.name: p.value for p in finding.parameters}
    for name, (value, off) in asked.values.items():
        assert values[name] == pytest.approx(value, abs=off)
    assert found.after.heldout_rms < 0.2 * found.before.heldout_rms


def test_motor_currents_under_the_name_of_torques_are_told_joint_by_joint(tmp_path):
    found = _case(tmp_path, _all_torques(1.0 / GAINS))
    said = {f.where["joint"]: f for f in found.findings if f.effect == "torque_constant"}
    assert sorted(said) == [
        1,
        2,
        3,
        4,
        5,
    ]  # joint 6 carries nothing: all it has is friction, in newton-metres or not
    for j, finding in said.items():
        scale = finding.parameters[0]
        assert abs(1.0 + scale.value - 1.0 / GAINS[j - 1]) < max(4.5 * scale.std, 0.02 / GAINS[j - 1])
        assert "currents" in finding.sentence


def test_a_log_as_its_header_says_is_left_as_it_is(tmp_path):
    found = _case(tmp_path, lambda run: None)
    assert not [f for f in found.findings if f.effect in (KIND, "gravity_direction", "torque_constant")]


@pytest.mark.parametrize("change", [_all_angles(DEGREES), _one_angle(3, DEGREES)], ids=["all", "one joint"])
def test_degrees_under_the_name_of_radians_are_refused_with_the_column(tmp_path, change):
    with pytest.raises(UnitError, match=r"degrees marked as radians"):
        _case(tmp_path, change)
