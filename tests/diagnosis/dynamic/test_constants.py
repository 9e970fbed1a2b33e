"""A large constant torque of a single joint beside small ones of all: a constant, and no spring without stiffness."""

import numpy as np

from app.diagnosis.dynamic import diagnose as whole
from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.dynamic.families import plainer
from app.kinematics import load_robot
from tests.diagnosis.dynamic.simulator import measure, swing, write

SMALL, LARGE, JOINT = np.array([0.6, -0.5, 0.4, -0.15, 0.12, 0.1]), 12.0, 2
DRY = np.array([6.0, 6.0, 4.0, 1.0, 1.0, 1.0])


def test_a_spring_whose_stiffness_is_nothing_gives_way_to_its_constant(tmp_path, monkeypatch):
    """Beside the family of small constants the large one cannot enter in the search, and a spring does."""
    robot, rng = load_robot("ur10e"), np.random.default_rng(5)
    run = swing(robot, rng, samples=3000)
    run.torque += SMALL + DRY * np.sign(run.qd)
    run.torque[:, JOINT - 1] += LARGE
    measure(run, rng, 0.005)
    kept, build = [], whole.build
    monkeypatch.setattr(
        whole, "build", lambda one, *rest, **more: kept.append(one) or build(one, *rest, **more)
    )
    found = diagnose(write(run, tmp_path / "log.csv", digits=7), robot)
    own = [f for f in found.findings if f.where.get("joint") == JOINT and f.effect != "coulomb_friction"]
    assert [f.effect for f in own] == ["friction_asymmetry"]
    offset = own[0].parameters[0]
    assert abs(offset.value - (LARGE + SMALL[JOINT - 1])) < 3.0 * offset.std

    study = kept[0].asked
    law = {g: study.label(g) for g in range(len(study.evidence.groups))}
    spring = next(
        g for g, c in law.items() if c.law.key == "joint_spring" and c.place.where["joint"] == JOINT
    )
    constants = next(g for g, c in law.items() if c.law.key == "friction_asymmetry" and c.whole)
    rest = {g: v for g, v in study.selection.items() if law[g].law.key != "friction_asymmetry"}
    study.selection = {**rest, constants: 0.1, spring: 1.0}
    chosen = [study.label(g) for g in plainer(study)]
    assert "joint_spring" not in [c.law.key for c in chosen]
    assert [c.place.where["joint"] for c in chosen if c.law.key == "friction_asymmetry" and not c.whole] == [
        JOINT
    ]
