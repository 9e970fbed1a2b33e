"""Everything the calibration catches is shown by the tool screen: by name, with its advice, in both languages."""

import re

import numpy as np
import pytest

from app.calibration.wording import TEXTS, name_of
from app.geometry import Pose, exp_so3, rot_z
from app.kinematics import solve_ik
from app.screens._tool.paper import calculate
from app.session.actions import ChooseMode, Record
from app.session.points import load_action
from tests.calibration.drawing import captures, touches
from tests.screens.tool.mistakes import (
    FLIP,
    SHIFT,
    TORCH,
    WRIST_TURNS,
    X,
    Y,
    Z,
    alike,
    almost_one_axis,
    both,
    by_joints,
    missed,
    spike_moved,
    taught,
    text_of,
    tilted,
    tip_bent,
    tool_left_active,
    touched,
)

#: Case -> the check's code, the file, what has to stand on the screen in English.
CASES = {
    "too few": ("too_few", lambda: text_of(touched(2)), ["2 touches", "at least 3", "tilted another way"]),
    "one axis": (
        "one_axis",
        lambda: text_of(captures(*touches(rotations=rot_z(np.arange(4.0) / 3)))),
        ["turn about one axis", "tilt the tool about another axis"],
    ),
    "almost one axis": ("one_axis", lambda: text_of(almost_one_axis()), ["almost about one axis", "across"]),
    "too alike": ("too_alike", lambda: text_of(alike()), ["2 and 4 (1.7 degrees)", "record touch 4 again"]),
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
    "wrist flipped": (
        "mixed_configuration",
        lambda: by_joints({3, 5}),
        ["the wrist was flipped over at touch 3, 5, not at 1, 2, 4", "record touch 3 again"],
    ),
    "joints and pose disagree": (
        "joints_disagree",
        lambda: both(lambda i, pose: SHIFT @ pose if i == 2 else pose),
        ["in row 6: by 50.00 mm", "leave out the columns"],
    ),
}


def load_and_calculate(desk, path):
    def job():
        desk.context.do(load_action(path))
        calculate(desk.context)

    desk.does(lambda: desk.tool._or_say(job))


@pytest.mark.parametrize("case", CASES)
def test_what_goes_wrong_is_shown_by_name_with_its_advice_in_both_languages(case, desk, tmp_path):
    code, text, words = CASES[case]
    path = tmp_path / "points.csv"
    path.write_text(text(), encoding="utf-8")
    load_and_calculate(desk.fresh(robot="ur10e"), path)
    said = desk.read()
    name = name_of(code)
    assert f"{name[:1].upper()}{name[1:]}: " in said
    for word in words:
        assert word in said, said
    if desk.state.result is not None:
        assert re.search('data-colour="(yellow|red)"', desk.tool.deciding.light.content)

    load_and_calculate(desk.fresh("zh", robot="ur10e"), path)
    said = desk.read()
    assert f"{name_of(code, 'zh')}: " in said
    assert not any(word in said for word in words if " " in word and not re.search(r"[\d(]", word))


@pytest.mark.parametrize("flipped", [(), (1, 2, 3, 4, 5)], ids=["none", "all"])
def test_one_configuration_whichever_it_is_is_no_mixed_one(flipped, desk, tmp_path):
    path = tmp_path / "points.csv"
    path.write_text(by_joints(set(flipped)), encoding="utf-8")
    load_and_calculate(desk.fresh(robot="ur10e"), path)
    codes = [warning.code for warning in desk.state.result.result.warnings]
    assert "mixed_configuration" not in codes


def test_a_flip_between_touches_recorded_by_hand_is_said(desk):
    """The wrist goes round and the tip comes back to the spike: the pendant says so when the result is there."""
    desk.fresh(robot="jby50").does(lambda: desk.context.do(ChooseMode("touch", 4)))
    world, home = desk.context.world, desk.context.model.home
    upright = world.hand(home).rotation
    for number, turn in enumerate(WRIST_TURNS[:4], 1):
        start = home + (FLIP if number == 2 else 0.0)
        start[4] *= -1.0 if number == 2 else 1.0
        aim = Pose.of(upright @ exp_so3(np.array(turn)), world.p_base_spike)
        q = solve_ik(world.robot, aim, start, T_flange_tool=world.T_flange_tool_true, max_steps=500).q
        desk.place(q)
        desk.does(lambda n=number: desk.context.do(Record(f"touch{n}")))
    desk.does(lambda: calculate(desk.context))
    assert "Wrist flipped between touches: the wrist was flipped over at touch 2, not at " in desk.read()


def test_every_check_and_every_refusal_has_a_case():
    named = {key.partition(".")[2] for key in TEXTS.languages["en"] if key.startswith("name.")}
    elsewhere = {"out_of_reach", "robust_undecided"}  # of the proposal, and of an estimator that is chosen
    assert {code for code, _, _ in CASES.values()} | elsewhere == named


def test_touches_recorded_by_hand_are_too_few_by_name(desk):
    desk.fresh().does(lambda: desk.context.do(ChooseMode("touch", 3)))
    desk.does(lambda: desk.context.do(Record("touch1")))
    desk.does(lambda: desk.tool._compute())
    assert "Too few points: 1 touch cannot" in desk.read()
    desk.does(lambda: desk.context.do(Record("touch2")))
    assert "Too few" not in desk.read()  # the next point answers it


def test_touches_all_alike_recorded_by_hand_are_refused_by_name(desk):
    desk.fresh().does(lambda: desk.context.do(ChooseMode("touch", 3)))
    for number in (1, 2, 3):
        desk.does(lambda n=number: desk.context.do(Record(f"touch{n}")))
    desk.does(lambda: desk.tool._compute())
    assert "One axis only: all touches have the same orientation" in desk.read()
