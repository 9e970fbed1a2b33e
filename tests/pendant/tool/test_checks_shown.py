"""Everything the calibration catches is shown by the tool screen: by name, with its advice, in both languages."""

import re

import numpy as np
import pytest

from app.calibration.captures import Capture
from app.calibration.wording import TEXTS, name_of
from app.geometry import CONVENTIONS, Pose, exp_so3, rot_x, rot_z
from app.kinematics import load_robot
from app.pendant.screens._tool.paper import calculate
from app.session.actions import ChooseMode, Record
from app.session.points import load_action
from app.units import deg, mm
from tests.calibration.drawing import TOOL, captures, stroke, touches
from tests.pendant.test_server import pytestmark  # noqa: F401  (same worker)

NOISE = 1e-4
X, Y, Z = np.eye(3)
ANGLES = "x_mm,y_mm,z_mm,a_deg,b_deg,c_deg"


def rows_of(points, convention="ZYX"):
    """Roles and numbers in mm and degrees, one a capture."""
    form = CONVENTIONS[convention]
    for c in points:
        angles = form.from_rotation(c.T_base_flange.rotation)
        yield c.role, [*mm(c.T_base_flange.position), *(deg(angles) if form.angular else angles)]


def text_of(points, *, written="ZYX", stated="ZYX", columns=ANGLES, length=1.0, angle=1.0):
    lines = [f"# angles: {stated}", f"role,{columns}"]
    for role, numbers in rows_of(points, written):
        scaled = [length * v for v in numbers[:3]] + [angle * v for v in numbers[3:]]
        lines.append(f"{role}," + ",".join(f"{v:.9f}" for v in scaled))
    return "\n".join(lines) + "\n"


def touched(count=5, seed=0, **rest):
    return captures(*touches(count, 0.6, NOISE, seed, **rest))


def taught(*strokes):
    points = touched(5)
    last = points[-1]
    points[-1] = Capture(last.step_key, "touch+origin", last.T_base_flange, None, last.row)
    return text_of(points + [stroke(last, role, *rest) for role, *rest in strokes])


def tilted(count=5, seed=0):
    """Touches whose three angles are all at work."""
    rotations = touches(count, 0.6, NOISE, seed)[0] @ rot_x(np.pi - 0.4)
    return captures(*touches(count, rotations=rotations, noise=NOISE, seed=seed))


def almost_one_axis():
    lean = exp_so3(np.outer(np.array([0.0, 0.03, 0.0, -0.03, 0.02]), X))
    return captures(*touches(rotations=rot_z(np.linspace(0, 2, 5)) @ lean, noise=1e-5))


def alike():
    rotations, _ = touches(5, 0.6)
    rotations[4] = rotations[2] @ rot_x(0.03)
    return captures(*touches(rotations=rotations, noise=NOISE))


def spike_moved(start):
    rotations, positions = touches(7, 0.6, NOISE, start)
    positions[start - 1 :] += np.array([0.002, -0.001, 0.0])
    return captures(rotations, positions)


def tip_bent():
    rotations, _ = touches(7, 0.6, seed=1)
    tools = np.array([TOOL] * 4 + [TOOL + 0.004 * X] * 3)
    positions = np.array([1.0, 0.1, 0.4]) - np.einsum("nij,nj->ni", rotations, tools)
    return captures(rotations, positions + np.random.default_rng(0).normal(0, NOISE, (7, 3)))


def missed():
    rotations, positions = touches(6, 0.6, NOISE, 2)
    positions[3] += np.array([0.0, 0.003, 0.0])
    return captures(rotations, positions)


def tool_left_active():
    rotations, positions = touches(5, 0.6, NOISE)
    return captures(rotations, positions + rotations @ TOOL)


def both(change):
    """Joints and poses of one arm, the poses changed by `change(i, pose)`."""
    robot, rng = load_robot("ur10e"), np.random.default_rng(3)
    lines = [
        "# robot: ur10e",
        "# angles: ZYX",
        f"role,{ANGLES}," + ",".join(f"q{j}_deg" for j in range(1, 7)),
    ]
    for i in range(5):
        q = robot.home + rng.normal(0, 0.4, 6)
        pose = change(i, robot.forward(q))
        numbers = [*mm(pose.position), *deg(CONVENTIONS["ZYX"].from_rotation(pose.rotation)), *deg(q)]
        lines.append("touch," + ",".join(f"{v:.6f}" for v in numbers))
    return "\n".join(lines) + "\n"


SHIFT = Pose.of(None, np.array([0.05, 0.0, 0.0]))
TORCH = Pose.of(rot_x(0.3), np.array([0.0, 0.01, 0.12]))

#: Case -> the check's code, the file, what has to stand on the screen in English.
CASES = {
    "too few": ("too_few", lambda: text_of(touched(2)), ["2 touches", "at least 3", "tilted another way"]),
    "one axis": (
        "one_axis",
        lambda: text_of(captures(*touches(rotations=rot_z(np.arange(4.0) / 3)))),
        ["turn about one axis", "tilt the tool about another axis"],
    ),
    "almost one axis": ("one_axis", lambda: text_of(almost_one_axis()), ["almost about one axis", "across"]),
    "too alike": ("too_alike", lambda: text_of(alike()), ["3 and 5 (1.7 degrees)", "record touch 5 again"]),
    "bumped spike": (
        "bumped",
        lambda: text_of(spike_moved(4)),
        ["from touch 4 on", "the spike moved by", "check spike and tip"],
    ),
    "bent tip": ("bumped", lambda: text_of(tip_bent()), ["from touch 5 on", "the tip bent by"]),
    "one that missed": ("bumped", lambda: text_of(missed()), ["touch 4 lies", "record it again"]),
    "orientation changed": (
        "orientation_changed",
        lambda: taught(("x", 0.15 * X), ("z", 0.15 * Z, rot_z(0.1))),
        ["turned by 5.7 degrees between the origin and Z", "straight lines"],
    ),
    "stroke too short": (
        "short_stroke",
        lambda: taught(("x", 0.15 * X), ("z", 0.02 * Z)),
        ["along Z is 20", "100 mm or more"],
    ),
    "tip did not move": (
        "short_stroke",
        lambda: taught(("x", 0 * X), ("z", 0.15 * Z)),
        ["did not move between the origin and X"],
    ),
    "X and Z nearly parallel": (
        "nearly_parallel",
        lambda: taught(("x", 0.15 * X), ("z", 0.15 * (X + 0.2 * Z))),
        ["along X and Z stand at", "right angle to X"],
    ),
    "X and Z parallel": (
        "nearly_parallel",
        lambda: taught(("x", 0.15 * X), ("z", -0.15 * X)),
        ["X and Z are parallel", "right angle"],
    ),
    "not square": ("not_square", lambda: taught(("x", 0.15 * X), ("z", 0.15 * (0.3 * X + Z))), ["not at 90"]),
    "left-handed": (
        "left_handed",
        lambda: taught(("x", 0.15 * X), ("y", -0.15 * Y), ("z", 0.15 * Z)),
        ["left-handed frame", "record them again"],
    ),
    "X and Y swapped": ("left_handed", lambda: taught(("x", 0.15 * Y), ("y", 0.15 * X)), ["may be swapped"]),
    "Z points back": ("axis_reversed", lambda: taught(("x", 0.15 * X), ("z", -0.15 * Z)), ["back towards"]),
    "tool still active": (
        "tool_active",
        lambda: text_of(tool_left_active()),
        ["turn about the tip itself", "choose tool 0"],
    ),
    "poses of an active tool": (
        "tool_active",
        lambda: both(lambda i, pose: pose @ TORCH),
        ["(0.0, 10.0, 120.0) mm, in every row", "choose tool 0"],
    ),
    "radians for degrees": (
        "convention",
        lambda: text_of(tilted(), angle=np.pi / 180),
        ["radians, not degrees", "correct the header"],
    ),
    "degrees for radians": (
        "convention",
        lambda: text_of(tilted(), columns="x_mm,y_mm,z_mm,a_rad,b_rad,c_rad"),
        ["degrees, not radians"],
    ),
    "wrong Euler order": (
        "convention",
        lambda: text_of(tilted(), written="XYZ", stated="ZYX"),
        ["look like XYZ (FANUC"],
    ),
    "another wrong order": (
        "convention",
        lambda: text_of(tilted(), written="ZYZ", stated="ZYX"),
        ["look like ZYZ (Kawasaki"],
    ),
    "rotation vector as Euler angles": (
        "convention",
        lambda: text_of(tilted(), written="rotvec", stated="XYZ"),
        ["look like rotvec (Universal Robots"],
    ),
    "metres for millimetres": ("units", lambda: text_of(touched(), length=1e-3), ["look like metres"]),
    "millimetres for metres": (
        "units",
        lambda: text_of(touched(), columns="x_m,y_m,z_m,a_deg,b_deg,c_deg"),
        ["look like millimetres"],
    ),
    "joints and pose disagree": (
        "joints_disagree",
        lambda: both(lambda i, pose: SHIFT @ pose if i == 2 else pose),
        ["in row 6: by 50.00 mm", "leave out the columns"],
    ),
}


def load_and_calculate(desk, path):
    def job():
        desk.pendant.do(load_action(path))
        calculate(desk.pendant)

    desk.does(lambda: desk.view._or_say(job))


@pytest.mark.parametrize("case", CASES)
def test_what_goes_wrong_is_shown_by_name_with_its_advice_in_both_languages(case, desk, tmp_path):
    code, text, words = CASES[case]
    path = tmp_path / "points.csv"
    path.write_text(text(), encoding="utf-8")
    load_and_calculate(desk.fresh(robot="ur10e"), path)
    said = desk.shown()
    name = name_of(code)
    assert f"{name[:1].upper()}{name[1:]}: " in said
    for word in words:
        assert word in said, said
    if desk.state.result is not None:
        assert re.search('data-colour="(yellow|red)"', desk.view.deciding.light.content)

    load_and_calculate(desk.fresh("zh", robot="ur10e"), path)
    said = desk.shown()
    assert f"{name_of(code, 'zh')}: " in said
    assert not any(word in said for word in words if " " in word and not re.search(r"[\d(]", word))


def test_every_check_and_every_refusal_has_a_case():
    named = {key.partition(".")[2] for key in TEXTS.languages["en"] if key.startswith("name.")}
    assert {code for code, _, _ in CASES.values()} | {"out_of_reach"} == named


def test_touches_recorded_by_hand_are_too_few_by_name(desk):
    desk.fresh().does(lambda: desk.pendant.do(ChooseMode("touch", 3)))
    desk.does(lambda: desk.pendant.do(Record("touch1")))
    desk.does(lambda: desk.view._compute())
    assert "Too few points: 1 touch cannot" in desk.shown()
    desk.does(lambda: desk.pendant.do(Record("touch2")))
    assert "Too few" not in desk.shown()  # the next point answers it


def test_touches_all_alike_recorded_by_hand_are_refused_by_name(desk):
    desk.fresh().does(lambda: desk.pendant.do(ChooseMode("touch", 3)))
    for number in (1, 2, 3):
        desk.does(lambda n=number: desk.pendant.do(Record(f"touch{n}")))
    desk.does(lambda: desk.view._compute())
    assert "One axis only: all touches have the same orientation" in desk.shown()
