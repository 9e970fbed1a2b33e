"""Two laws written apart, the generator's and the diagnosis library's, say the same of the same effect."""

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from app import catalog
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.every_sample import EverySample
from app.diagnosis.models.dynamic.hypothesis import as_given
from app.diagnosis.models.dynamic.smoothing import Motion
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.models.kinematic.cell import nominal_cell, pose
from app.diagnosis.models.kinematic.situation import situation_for
from app.diagnosis.observations.conventions import QUARTER, SIGN, SWAP
from app.diagnosis.observations.joint_log import Log
from app.kinematics import load_robot
from app.kinematics.dynamics import (
    flange_to_last_link,
    gravity_and_wrench_columns,
    inertial_parameters,
)
from app.kinematics.regressor import torque_regressor
from app.proof.generator.effects.term import Request
from app.proof.generator.motion.cell import STANDSTILL, effect_on_torques
from app.proof.generator.motion.making import MotionPlan, make_motion
from app.proof.generator.static.cell import contact, goals, seen, world_with
from app.proof.generator.static.making import Plan, make
from app.proof.generator.urdf import read_arm
from tests.proof.arms import random_arm

SAME_PLACE = 1e-9  # m
SAME_TORQUE = 1e-6  # relative to the largest torque of the effect
INTERPOLATED = 0.02  # relative; the library interpolates a late torque linearly between samples
TWISTED = 0.1  # relative; the library leaves out what a twist changes in speeds and in other inertias
MOVING = 0.03  # rad/s; slower, the two round off the sign of the speed differently

OURS = catalog.members("app.proof.generator.effects.static", "EFFECT")
THEIRS = catalog.members("app.diagnosis.effects.kinematic", "EFFECT")
OURS_MOTION = catalog.members("app.proof.generator.effects.motion", "EFFECT")
THEIRS_MOTION = catalog.members("app.diagnosis.effects.dynamic", "EFFECT")


def _place_and_values(effect, situation, term):
    """The library's place and values for a term of the generator."""
    given = dict(term.parameters)
    if term.effect == "wrong_convention":
        j = float(term.where["joint"])
        kind = SWAP if "source_joint" in term.where else QUARTER if given else SIGN
        fixed = {
            "kind": kind,
            "joint": j,
            "other": term.where.get("source_joint", 1.0),
            "turn": given.get("turn", 0.0),
        }
        return Place(term.where, fixed), np.zeros(0)
    if term.effect == "payload":
        given |= {f"moment_{c}": given["mass"] * given[f"com_{c}"] for c in "xyz"}
    step = {k: v for k, v in term.where.items() if k == "from_row"}
    wanted = {k: v for k, v in term.where.items() if k != "from_row"}
    fits = []
    for place in effect.places(situation):
        names = [q.name for q in effect.quantities(situation, place)]
        same = {k: v for k, v in place.where.items() if k != "kind"} == wanted
        if same and bool(step) == place.scan and set(names) <= set(given):
            fits.append((place, names))
    place, names = max(fits, key=lambda fit: len(fit[1]))
    return Place({**place.where, **step}, place.fixed), np.array([given[name] for name in names])


@pytest.mark.parametrize("topology", ["spherical_wrist", "offset_wrist", "seven_axes"])
@pytest.mark.parametrize("seed", [4, 5])
@pytest.mark.parametrize("key", sorted(set(OURS) & set(THEIRS)))
def test_the_library_moves_the_tool_as_the_generator_does(key, topology, seed, tmp_path):
    _, path = random_arm(topology, tmp_path, 1)
    arm, robot = read_arm(path), load_robot(path)
    kind = "touch" if key == "touch_indentation" else "tracker"
    plan = Plan(kind=kind, samples=24, noise=1e-9, sessions=1, targets=2, loads_kg=(0.0, 3.0))
    if key == "payload":
        plan = Plan(kind=kind, samples=24, noise=1e-9, declares_compliance=True)
    made = make(plan, arm, arm, [Request(key)], np.random.default_rng(seed))
    cell, term = made.cell, made.terms[0]
    situation = situation_for(
        robot,
        cell.q,
        payload=cell.load_kg,
        payload_com=cell.load_at,
        declared_compliance=cell.compliance,
        time=cell.t,
    )
    place, values = _place_and_values(THEIRS[key], situation, term)
    there = THEIRS[key].apply(nominal_cell(situation), situation, place, values)
    points = pose(situation, there, cell.tools[0]).points
    if kind == "touch":
        assert np.abs(points[:, 0] - contact(cell, world_with(cell, made.terms))[0]).max() < SAME_PLACE
        return
    view = cell.views[0]
    points = points @ view[:3, :3].T + view[:3, 3]
    distance = np.linalg.norm(points, axis=-1, keepdims=True)
    measured = points * there.scale[:, None, None] + there.zero[:, None, None] * points / distance
    assert np.abs(measured - seen(cell, world_with(cell, made.terms))).max() < SAME_PLACE
    nothing = seen(cell, world_with(cell, ()))
    assert np.abs(measured - nothing).max() > 1e-5  # both really move it


def _state(robot, cell) -> State:
    """The library's state of the generator's exact motion."""
    q, qd, qdd = cell.state
    columns = torque_regressor(robot, q, qd, qdd)
    rigid = columns @ inertial_parameters(robot)
    gravity, force = gravity_and_wrench_columns(robot, q)
    n = cell.arm.n
    step = float(cell.t[1] - cell.t[0])
    log = {"t": cell.t, "step": step, "segments": [slice(0, cell.m)], "motor": None}
    return State(
        hypothesis=as_given(n),
        t=cell.t,
        q=q,
        qd=qd,
        qdd=qdd,
        fine=qd[:, None],
        regressor=columns,
        torque=rigid,
        drive=rigid,
        levers=lambda: (gravity, force),
        payload_columns=columns[:, :, -10:] @ flange_to_last_link(robot),
        temperature=None,
        commanded=None,
        speed=np.quantile(np.abs(qd), 0.9, axis=0),
        seconds=float(cell.t[-1]),
        window=0.0,
        sliding=np.zeros(n, bool),
        width=np.full(n, STANDSTILL),
        slip=np.zeros(n),
        still=np.full(n, STANDSTILL),
        size=np.ones(n),
        link_mass=np.ones(n),
        link_size=np.ones(n),
        every=EverySample(
            cast(Log, SimpleNamespace(**log)),
            robot,
            cast(Motion, SimpleNamespace(q=q, qd=qd, qdd=qdd)),
            as_given(n),
            inertial_parameters(robot),
            np.arange(cell.m),
            1,
        ),
    )


@pytest.mark.parametrize("topology", ["spherical_wrist", "seven_axes"])
@pytest.mark.parametrize("key", sorted(set(OURS_MOTION) & set(THEIRS_MOTION)))
def test_the_library_adds_the_torque_that_the_generator_does(key, topology, tmp_path):
    _, path = random_arm(topology, tmp_path, 1)
    arm, robot = read_arm(path), load_robot(path)
    made = make_motion(MotionPlan(samples=1200), arm, arm, [Request(key)], np.random.default_rng(4))
    term = made.terms[0]
    ours = effect_on_torques(made.cell, made.terms, term)
    theirs, parameters = np.zeros_like(ours), term.parameters
    if key == "link_inertia":  # a heavier link by one number, where the library has all ten
        k = term.where["link"] - 1
        ten = inertial_parameters(robot)[10 * k : 10 * k + 10]
        parameters = dict(zip(THEIRS_MOTION[key].linear, ten * parameters["mass"] / ten[0], strict=True))
    if key == "elastic_joint":  # all that is described swings
        parameters = {**parameters, "share": 1.0}
    for joint, torque in THEIRS_MOTION[key].torque(_state(robot, made.cell), term.where, parameters).items():
        theirs[:, joint] = torque
    moving = np.abs(made.cell.qd) > MOVING
    moving[:10] = False  # a late torque has no past at the start
    assert np.all(moving.sum(axis=0) > 100)
    size = np.abs(ours).max()
    tolerance = {"delay": INTERPOLATED, "elastic_joint": TWISTED}.get(key, SAME_TORQUE)
    assert np.abs(theirs - ours)[moving].max() < tolerance * size


def test_what_a_joint_carries_follows_from_where_it_stands_not_from_a_wrong_label(tmp_path):
    _, path = random_arm("spherical_wrist", tmp_path, 1)
    arm = read_arm(path)
    requests = [Request("joint_compliance", {"joint": 3}), Request("wrong_convention", {"joint": 2})]
    plan = Plan(kind="tracker", samples=24, noise=1e-9)
    made = make(plan, arm, arm, requests, np.random.default_rng(3))
    really = made.cell.q.copy()
    really[:, 1] *= -1.0
    bend = made.terms[0].parameters["compliance"] * made.cell.at(really).holding[:, 2]
    shown = made.terms[0].parameters["compliance"] * made.cell.holding[:, 2]
    assert np.abs(bend - shown).max() > 0.1 * np.abs(bend).max()  # else the test could not tell
    assert np.allclose(world_with(made.cell, made.terms).dq[:, 2], -bend)


@pytest.mark.parametrize("where", [{"joint": 2}, {"joint": 4}, {"joint": 5, "source_joint": 6}])
def test_a_tip_touches_its_target_however_the_joints_are_written_down(where, tmp_path):
    _, path = random_arm("spherical_wrist", tmp_path, 2)
    arm = read_arm(path)
    plan = Plan(kind="touch", samples=24, noise=1e-9, targets=3)
    made = make(plan, arm, arm, [Request("wrong_convention", where)], np.random.default_rng(8))
    world = world_with(made.cell, made.terms)
    assert np.abs(contact(made.cell, world)[0] - goals(made.cell, world)).max() < 1e-6
