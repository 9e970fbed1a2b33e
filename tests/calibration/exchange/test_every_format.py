"""Tool frames survive the journey, and texts as the makers write them are understood."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from app.calibration.exchange import ToolFrame, exchange_format, formats, read_frame
from app.cli import run
from app.errors import FileFormatError
from app.geometry import Pose, exp_so3, rot_y
from app.resources import STATIC

POSITION, ROTATION = 1e-9, 1e-8  # the texts carry 1e-7 mm and 1e-7 degrees
#: A FANUC controller itself writes three decimals of millimetres and degrees.
COARSE = {"fanuc_utool": (1e-6, 4e-5)}
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
@example(ToolFrame("0" * 18 + ":0", Pose.of(None)))  # cut where a blank stood
def test_a_frame_that_is_written_is_read_back(key, frame):
    form = exchange_format(key)
    text = form.write(frame)
    assert form.knows(text)
    assert [k for k, f in formats().items() if f.knows(text)] == [key]
    found = form.read(text)
    position, rotation = COARSE.get(key, (POSITION, ROTATION))
    np.testing.assert_allclose(found.pose.position, frame.pose.position, atol=position)
    np.testing.assert_allclose(found.pose.rotation, frame.pose.rotation, atol=rotation)
    assert found.name == frame.name
    if key in ("abb_rapid", "kuka_krl", "ur_script", "json", "csv") and frame.mass > 0:
        assert found.mass == pytest.approx(frame.mass, abs=1e-6)
        np.testing.assert_allclose(found.com, frame.com, atol=1e-8)


#: The same tool in other ways it comes from a controller or a workspace.
MORE_TEXTS = {
    "RAPID with a tool that is commented out": (
        "abb_rapid",
        "MODULE m\n  ! PERS tooldata old:=[TRUE,[[1,2,3],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
        "  TASK PERS tooldata torch:=[TRUE,[[1.195E+02,0,352],[0.707106781,0,0.707106781,0]],"
        "[-1,[0,0,0],[1,0,0,0],0,0,0]];",
    ),
    "$config.dat, where tool 1 is not used": (
        "kuka_krl",
        "DEFDAT $CONFIG\nDECL FRAME NULLFRAME={FRAME: X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0}\n"
        'TOOL_DATA[1]={X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0}\nTOOL_NAME[1,]="none"\n'
        'TOOL_DATA[2]={x 119.5,y 0.0,z 352.0,a 0.0,b 90.0,c 0.0}\nTOOL_NAME[2,]="torch"\nENDDAT',
    ),
    "KRL with the type in the aggregate": (
        "kuka_krl",
        "; $TOOL={X 1.0,Y 1.0,Z 1.0,A 0.0,B 0.0,C 0.0}\n$TOOL={FRAME: X 119.5,Y 0.0,Z 352.0,A 0.0,B 90.0,C 0.0}",
    ),
    "sysframe.va, where user frames come first": (
        "fanuc_utool",
        "[*SYSTEM*]$MNUFRAME  Storage: SHADOW  Access: RW  : ARRAY[1,9] OF POSITION\n"
        "     [1,1] =   Group: 1   Config: N D B, 0, 0, 0\n  X:   900.000   Y:     1.000   Z:     2.000\n"
        "  W:     0.000   P:     0.000   R:    45.000\n"
        "[*SYSTEM*]$MNUTOOL  Storage: SHADOW  Access: RW  : ARRAY[1,10] OF POSITION\n"
        "     [1,1] =   Group: 1   Config: N D B, 0, 0, 0\n  X:     0.000   Y:     0.000   Z:     0.000\n"
        "  W:     0.000   P:     0.000   R:     0.000\n"
        "     [1,2] =   Group: 1   Config: N D B, 0, 0, 0\n  X:   119.500   Y:     0.000   Z:   352.000\n"
        "  W:     0.000   P:    90.000   R:     0.000\n",
    ),
    "a TP program with a position": (
        "fanuc_utool",
        "/PROG  A\n/MN\n   1:  PR[6:tool]=P[2] ;\n   2:  UTOOL[1]=PR[6:tool] ;\n/POS\n"
        "P[1]{\n   GP1:\n\tUF : 0, UT : 1,\t\tCONFIG : 'N U T, 0, 0, 0',\n"
        "\tX =  1.000  mm,\tY =  2.000  mm,\tZ =  3.000  mm,\n\tW =  4.000 deg,\tP =  5.000 deg,\tR =  6.000 deg\n};\n"
        "P[2]{\n   GP1:\n\tUF : 0, UT : 1,\t\tCONFIG : 'N U T, 0, 0, 0',\n"
        "\tX =  119.500  mm,\tY =  0.000  mm,\tZ =  352.000  mm,\n"
        "\tW =  .000 deg,\tP =  90.000 deg,\tR =  -.000 deg\n};\n/END",
    ),
    "a TP program number by number": (
        "fanuc_utool",
        "15: PR[1,1] = 119.5 ;\n16: PR[1,2]=0 ;\n17: PR[1,3]=352 ;\n18: PR[1,4]=(-0.0) ;\n19: PR[1,5]=90 ;\n"
        "20: PR[1,6]=0 ;\n21: UTOOL[1]=PR[1] ;",
    ),
    "xacro with pi": (
        "urdf_joint",
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><joint name="j" type="fixed">'
        '<parent link="flange"/>'
        '<child link="torch"/><origin xyz="${0.1 + 0.0195} 0 0.352" rpy="0 ${pi / 2} ${-radians(0)}"/></joint></robot>',
    ),
    "ROS 2 over several lines": (
        "ros_static",
        "ros2 run tf2_ros static_transform_publisher --x 0.1195 --z 0.352 \\\n  --pitch 1.5707963267948966 \\\n"
        "  --frame-id flange --child-frame-id torch\n",
    ),
    "a ROS launch file": (
        "ros_static",
        '<launch><node pkg="tf2_ros" exec="static_transform_publisher" name="t" '
        'args="0.1195 0 0.352 0 1.5707963267948966 0 flange torch"/></launch>',
    ),
}


@pytest.mark.parametrize("name", MORE_TEXTS)
def test_other_ways_in_which_the_same_tool_is_written_are_understood(name):
    key, text = MORE_TEXTS[name]
    assert exchange_format(key).knows(text)
    found = exchange_format(key).read(text)
    np.testing.assert_allclose(found.pose.matrix, EXPECTED.matrix, atol=1e-7)
    assert found.name in ("torch", "tool")


def test_what_is_written_has_the_shape_a_controller_loads():
    frame = ToolFrame("torch", EXPECTED, 2.5, (0.0, 0.0, 0.1))
    krl = exchange_format("kuka_krl").write(frame).splitlines()
    assert krl[0] == "DEF torch( )" and krl[-1] == "END"
    assert "TOOL_DATA[1]={X 119.5,Y 0.0,Z 352.0,A 0.0,B 90.0,C 0.0}" in krl
    assert "LOAD_DATA[1]={M 2.5,CM {X 0.0,Y 0.0,Z 100.0,A 0.0,B 0.0,C 0.0},J {X 0.0,Y 0.0,Z 0.0}}" in krl
    rapid = exchange_format("abb_rapid").write(frame)
    assert "PERS tooldata torch:=[TRUE,[[119.5,0,352],[0.70710678" in rapid
    assert "],[2.5,[0,0,100],[1,0,0,0],0,0,0]];" in rapid
    program = exchange_format("fanuc_utool").write(frame)
    for line in ("/PROG  SETTOOL", "   3:  PR[100]=P[1] ;", "   4:  UTOOL[1]=PR[100] ;", "/POS", "/END"):
        assert line in program.splitlines()
    assert "\tX =   119.500  mm,\tY =     0.000  mm,\tZ =   352.000  mm," in program
    script = exchange_format("ur_script").write(frame)
    assert "set_tcp(p[0.1195, 0, 0.352, 0, 1.570796326795, 0])" in script
    assert "set_target_payload(2.5, [0, 0, 0.1])" in script


@pytest.mark.parametrize("key", TEXTS)
def test_a_text_as_the_maker_writes_it_is_understood(key, tmp_path):
    path = tmp_path / ("torch" + exchange_format(key).suffix)
    path.write_text(TEXTS[key], encoding="utf-8")
    found = read_frame(path)
    np.testing.assert_allclose(found.pose.matrix, EXPECTED.matrix, atol=1e-7)
    assert found.name == "torch"


@pytest.mark.parametrize(
    "given_, name",
    [("工具 1", "tool_1"), ("", "tool"), ("2 torch", "tool_2_torch"), ("a" * 40, "a" * 24), ("__x", "x")],
)
def test_any_name_becomes_one_that_every_controller_takes(given_, name):
    frame = ToolFrame(given_, EXPECTED)
    assert frame.name == name and ToolFrame(frame.name, EXPECTED).name == name


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
        (
            "abb_rapid",
            "PERS tooldata t:=[FALSE,[[1,2,3],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];",
            "stands still",
        ),
        ("fanuc_utool", "1: PR[1,1]=5 ;\n2: UTOOL[1]=PR[1] ;", "whole frame"),
        (
            "urdf_joint",
            '<robot><joint type="fixed"><origin rpy="0 ${arm} 0"/></joint></robot>',
            "numbers and pi",
        ),
        (
            "urdf_joint",
            '<robot><joint type="fixed"><origin rpy="0 ${1/0} 0"/></joint></robot>',
            "numbers and pi",
        ),
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
