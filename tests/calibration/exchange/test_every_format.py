"""Tool frames survive the journey, and texts as the makers write them are understood."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from app.calibration.exchange import ToolFrame, exchange_format, formats, read_frame
from app.cli import run
from app.errors import FileFormatError, TeachframeError
from app.geometry import Pose, exp_so3, rot_y
from app.resources import STATIC

POSITION, ROTATION = 1e-9, 1e-8  # the texts carry 1e-7 mm and 1e-10 degrees
HALF = np.sqrt(0.5)
EXPECTED = Pose.of(rot_y(np.pi / 2), np.array([0.1195, 0.0, 0.352]))

#: The same tool as each maker's manual would write it.
TEXTS = {
    "abb_rapid": "MODULE m\n PERS tooldata torch := [ TRUE, [[119.5,0,352],[0.707106781,0,0.707106781,0]],"
    "\n [2.5,[0,0,80],[1,0,0,0],0,0,0]];\nENDMODULE",
    "kuka_krl": '&ACCESS RVP\nTOOL_DATA[3]={X 119.5,Y 0.0,Z 352.0,A 0.0,B 90.0,C 0.0}\nTOOL_NAME[3,]="torch"',
    "fanuc_utool": "     [1,2] =   Comment: 'torch'\n  Group: 1   Config: N U T, 0, 0, 0\n"
    "  X:   119.500   Y:     0.000   Z:   352.000\n  W:     0.000   P:    90.000   R:     0.000\n",
    "ur_script": "def p():\n  # tool: torch\n  set_tcp(p[0.1195, 0.0, .352, 0, 1.5707963267948966, 0])\nend",
    "urdf_joint": '<robot xmlns:xacro="x"><joint name="j" type="fixed"><parent link="tool0"/><child link="torch"/>'
    '<origin xyz="0.1195 0 0.352" rpy="0 1.5707963267948966 0"/></joint></robot>',
    "ros_static": "rosrun tf static_transform_publisher 0.1195 0 0.352 0 1.5707963267948966 0 tool0 torch 100",
    "json": '{"format": "teachframe.tool/1", "name": "torch", "tool_mm": [119.5, 0, 352],'
    f' "quaternion_wxyz": [{HALF}, 0, {HALF}, 0], "delta_mm": 0.1}}',
    "csv": f"name,x_mm,y_mm,z_mm,qw,qx,qy,qz\ntorch,119.5,0,352,{HALF},0,{HALF},0\n",
}


def frames():
    small = st.floats(-0.8, 0.8, allow_subnormal=False)
    turn = st.floats(-1.8, 1.8, allow_subnormal=False)
    return st.builds(
        lambda name, p, w, mass, com: ToolFrame(name, Pose.of(exp_so3(np.array(w)), np.array(p)), mass, com),
        st.text(max_size=40),
        st.tuples(small, small, small),
        st.tuples(turn, turn, turn),
        st.floats(0.01, 50.0),
        st.tuples(small, small, small),
    )


@pytest.mark.parametrize("key", formats())
@settings(max_examples=40, deadline=None)
@given(frames())
@example(ToolFrame("up", Pose.of(rot_y(np.pi / 2))))  # where two of three angles turn about one axis
@example(ToolFrame("over", Pose.of(rot_y(np.pi))))
def test_a_frame_that_is_written_is_read_back(key, frame):
    form = exchange_format(key)
    text = form.write(frame)
    assert form.knows(text)
    assert [k for k, f in formats().items() if f.knows(text)] == [key]
    found = form.read(text)
    np.testing.assert_allclose(found.pose.position, frame.pose.position, atol=POSITION)
    np.testing.assert_allclose(found.pose.rotation, frame.pose.rotation, atol=ROTATION)
    assert found.name == frame.name
    if key in ("abb_rapid", "kuka_krl", "ur_script", "json", "csv") and frame.mass > 0:
        assert found.mass == pytest.approx(frame.mass, abs=1e-6)
        np.testing.assert_allclose(found.com, frame.com, atol=1e-8)


@pytest.mark.parametrize("key", TEXTS)
def test_a_text_as_the_maker_writes_it_is_understood(key, tmp_path):
    path = tmp_path / ("torch" + exchange_format(key).suffix)
    path.write_text(TEXTS[key], encoding="utf-8")
    found = read_frame(path)
    np.testing.assert_allclose(found.pose.matrix, EXPECTED.matrix, atol=1e-7)
    assert found.name == "torch"


def test_every_format_has_a_makers_text():
    assert set(TEXTS) == set(formats())


def test_ros_quaternions_stand_in_the_order_x_y_z_w():
    text = f"ros2 run tf2_ros static_transform_publisher 0.1195 0 0.352 0 {HALF} 0 {HALF} tool0 torch"
    np.testing.assert_allclose(
        exchange_format("ros_static").read(text).pose.matrix, EXPECTED.matrix, atol=1e-9
    )


@pytest.mark.parametrize(
    "key, text, says",
    [
        ("abb_rapid", "PERS tooldata t:=[TRUE,[[1,2],[1,0,0,0]]];", "6 numbers"),
        ("abb_rapid", "PERS tooldata t:=[TRUE,[[1,2,3],[0,0,0,0]],[]];", "length 0"),
        ("kuka_krl", "$TOOL={X 1,Y 2,Z 3,A 0,B 0}", "column C"),
        ("kuka_krl", "$TOOL={X 1,Y two,Z 3,A 0,B 0,C 0}", "'two'"),
        ("fanuc_utool", "X: 1 Y: 2", "no tool frame"),
        ("ur_script", "set_tcp(p[1e9,0,0,0,0,0])", "finite"),
        ("urdf_joint", '<robot><joint type="fixed"><origin xyz="0 0"/></joint></robot>', "2 numbers"),
        ("urdf_joint", '<!DOCTYPE x [<!ENTITY a "b">]><robot/>', "entities"),
        ("ros_static", "static_transform_publisher 1 2 3", "3 numbers"),
        ("json", '{"format": "other/1", "tool_mm": [0,0,0], "quaternion_wxyz": [1,0,0,0]}', "other/1"),
        ("json", '{"format": 3}', "cannot be read"),
        ("csv", "name,x_mm,y_mm\n", "column z_mm"),
        ("csv", "name,x_mm,y_mm,z_mm,qw,qx,qy,qz\nt,1,2,3,nan,0,0,0\n", "'nan'"),
    ],
)
def test_a_text_that_cannot_be_used_is_refused_with_its_reason(key, text, says):
    with pytest.raises(FileFormatError, match=says):
        exchange_format(key).read(text)


@pytest.mark.parametrize("key", formats())
@settings(max_examples=80, deadline=None)
@given(st.data())
def test_whatever_stands_in_a_text_only_the_projects_errors_come_out(key, data):
    good = exchange_format(key).write(ToolFrame("torch", EXPECTED, 2.0, (0.0, 0.0, 0.1)))
    text = data.draw(st.one_of(st.text(max_size=200), mangled(good), mangled(TEXTS[key])))
    try:
        found = exchange_format(key).read(text)
    except TeachframeError as error:
        assert "\n" not in str(error)
    else:
        assert np.isfinite(found.pose.matrix).all()
        np.testing.assert_allclose(found.pose.rotation.T @ found.pose.rotation, np.eye(3), atol=1e-2)


def mangled(text):
    """A good text with a piece cut out, doubled or replaced."""
    places = st.integers(0, len(text))
    pieces = st.one_of(
        st.text(max_size=8), st.sampled_from(["nan", "inf", "1e999", "-", "0" * 400, "{", "]", "\x00"])
    )
    return st.builds(
        lambda a, b, piece: text[: min(a, b)] + piece + text[max(a, b) :], places, places, pieces
    )


def test_a_file_of_no_known_format_lists_those_there_are(tmp_path):
    for content in (b"hello", b"\xff\xfe\x00", b"", b"x" * 1_000_001):
        path = tmp_path / "tool.txt"
        path.write_bytes(content)
        with pytest.raises(FileFormatError, match=r"tool\.txt"):
            read_frame(path)
    with pytest.raises(FileFormatError, match="cannot be read"):
        read_frame(tmp_path / "none.txt")


def test_the_command_line_solves_exports_and_converts(tmp_path, capsys):
    points = STATIC / "samples" / "xiong2012_table1.csv"
    assert (
        run(["export", str(points), "--to", "kuka_krl", "--name", "torch", "--out", str(tmp_path / "t.src")])
        == 0
    )
    assert run(["export", str(tmp_path / "t.src"), "--to", "abb_rapid", "--mass-kg", "2.5"]) == 0
    text = capsys.readouterr().out
    assert "tooldata torch:=[TRUE,[[119.244" in text and "[2.5," in text
    assert run(["export", str(tmp_path / "nothing.csv")]) == 2
    assert "no such file" in capsys.readouterr().err
