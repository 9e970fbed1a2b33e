"""Which tool of a controller's file is meant: comments, the bare flange, programs and registers are none; several
without a choice are refused with their list; a file is searched to its end."""

import json
from itertools import product

import pytest

from app.calibration.exchange import read_frame
from app.cli import run
from app.errors import FileFormatError, UnknownNameError
from app.units import mm

RAPID = "  PERS tooldata {}:=[TRUE,[[{},{},{}],[1,0,0,0]],[3,[0,0,30],[1,0,0,0],0,0,0]];\n"
THREE = "MODULE Tools\n" + "".join(
    RAPID.format(*t) for t in (("tOpen", 0, 1, 330), ("tClosed", 0, 11, 330), ("tLong", 43, -21, 270))
)
KRL = 'TOOL_DATA[{}]={{X {},Y 0.0,Z {},A 0.0,B 0.0,C 0.0}}\nTOOL_NAME[{},]="{}"\n'
LISTED = (
    "     [1,{}] =  '{}'   Group: 1   Config: N D B, 0, 0, 0\n"
    "  X: {:9.3f}   Y:     0.000   Z: {:9.3f}\n  W:     0.000   P:     0.000   R:     0.000\n"
)
POSREG = "[*POSREG*]$POSREG  Storage: SHADOW  Access: RW  : ARRAY[1,100] OF Position Reg\n"
MNUTOOL = "[*SYSTEM*]$MNUTOOL  Storage: SHADOW  Access: RW  : ARRAY[1,10] OF POSITION\n"
POSITION = (
    "P[{}]{{\n   GP1:\n\tUF : 0, UT : 2,\t\tCONFIG : 'N U T, 0, 0, 0',\n\tX = {:9.3f}  mm,\tY =   120.000  mm,"
    "\tZ =  1800.000  mm,\n\tW =   -70.000 deg,\tP =    12.000 deg,\tR =   -35.000 deg\n}};\n"
)
SEVERAL = {
    "abb.mod": THREE,
    "kuka.dat": "DEFDAT $CONFIG\n" + KRL.format(3, 1.5, 330, 3, "tOpen") + KRL.format(4, 43, 270, 4, "tLong"),
    "fanuc.va": MNUTOOL + LISTED.format(3, "tOpen", 1.0, 330) + LISTED.format(4, "tLong", 43.0, 270),
    "ur.script": "# tool: tOpen\nset_tcp(p[0,0,0.33,0,0,0])\n# tool: tLong\nset_tcp(p[0.043,0,0.27,0,0,0])\n",
    "ros.launch": "\n".join(
        f'<node exec="static_transform_publisher" args="{x} 0 {z} 0 0 0 flange {name}"/>'
        for x, z, name in ((0, 0.33, "tOpen"), (0.043, 0.27, "tLong"))
    ),
    "tool.csv": "name,x_mm,y_mm,z_mm,qw,qx,qy,qz\ntOpen,0,1,330,1,0,0,0\ntLong,43,-21,270,1,0,0,0\n",
    "arm.urdf": '<robot name="r">'
    + "".join(
        f'<joint type="fixed" name="j_{n}"><child link="{n}"/><origin xyz="{x} 0 {z}"/></joint>'
        for x, z, n in ((0, 0.33, "tOpen"), (0.043, 0.27, "tLong"))
    )
    + "</robot>",
}
#: A file of each kind in which one tool stands beside what is none.
ONE = {
    "RAPID: tool0 and a comment": (
        "base.mod",
        "MODULE BASE (SYSMODULE)\n"
        + RAPID.format("tool0", 0, 0, 0)
        + "!"
        + RAPID.format("tOld", 1, 2, 3)
        + RAPID.format("tPen", 10, 0, 150),
    ),
    "KRL: unused tools, a base and a place": (
        "x.dat",
        "DEFDAT $CONFIG\nDECL FRAME SHELF={X 900.0,Y 0.0,Z 1.0,A 0.0,B 0.0,C 0.0}\n"
        "DECL E6POS XP1={X 1.0,Y 2.0,Z 3.0,A 0.0,B 0.0,C 0.0,S 2,T 35}\n"
        "BASE_DATA[1]={X 500.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0}\n"
        + KRL.format(1, 0.0, 0.0, 1, "none")
        + KRL.format(2, 10.0, 150.0, 2, "tPen"),
    ),
    "KRL: the program's own frame": (
        "x.src",
        "DECL FRAME GREIF={X 10.0,Y 0.0,Z 150.0,A 0.0,B 0.0,C 0.0}\n"
        "DECL FRAME ABLAGE={X 1.0,Y 0.0,Z 1.0,A 0.0,B 0.0,C 0.0}\n$TOOL=GREIF\n",
    ),
    "FANUC: registers and frames around the tools": (
        "sys.va",
        POSREG
        + LISTED.format(1, "HOME", -2255.0, 950.0)
        + MNUTOOL.replace("MNUTOOL", "MNUFRAME")
        + LISTED.format(1, "", 5.0, 6.0)
        + MNUTOOL
        + LISTED.format(1, "", 0.0, 0.0)
        + LISTED.format(2, "tPen", 10.0, 150.0)
        + POSREG
        + LISTED.format(2, "AWAY", 1.0, 2.0),
    ),
    "FANUC: a remark, and a program that sets it": (
        "w.ls",
        "/PROG  W\n/MN\n   1:  //UTOOL[1]=PR[3] ;\n   2:  PR[5]=P[1] ;\n   3:  PR[5,1]=10 ;\n   4:  PR[5,2]=0 ;\n"
        "   5:  PR[5,3]=150 ;\n   6:  PR[5,4]=0 ;\n   7:  PR[5,5]=0 ;\n   8:  PR[5,6]=0 ;\n"
        "   9:  UTOOL[2]=PR[5] ;\n/POS\n" + POSITION.format(1, 1100.0) + "/END",
    ),
    "URScript: zeros first, a comment, the same twice": (
        "p.script",
        "def p():\n  set_tcp(p[0.0,0.0,0.0,0.0,0.0,0.0])\n  # set_tcp(p[0,0,0.1,0,0,0])\n"
        "  set_tcp(p[0.01,0,0.15,0,0,0])\n  set_tcp(p[0.01,0,0.15,0,0,0])\nend",
    ),
    "ROS: the camera's identity": (
        "l.launch",
        '<node exec="static_transform_publisher" args="0 0 0 0 0 0 flange camera"/>\n'
        '<node exec="static_transform_publisher" args="0.01 0 0.15 0 0 0 flange tPen"/>',
    ),
    "URDF: a joint without a step": (
        "a.urdf",
        '<robot><joint type="fixed"><child link="tool0"/><origin xyz="0 0 0"/></joint>'
        '<joint type="fixed"><child link="tPen"/><origin xyz="0.01 0 0.15"/></joint></robot>',
    ),
}
NONE = {
    "weld.ls": (
        "/PROG  WELD1\n/MN\n   2:  UTOOL_NUM=2 ;\n   3:J P[1] 100% FINE ;\n/POS\n" + POSITION.format(1, 1),
        "UTOOL",
    ),
    "posreg.va": (POSREG + LISTED.format(1, "HOME", -2255.0, 950.0), "UTOOL"),
    "move.src": (
        "DEF move()\nDECL E6POS XP1={X 1.0,Y 2.0,Z 3.0,A 0.0,B 0.0,C 0.0}\nPTP XP1\nEND\n",
        "TOOL_DATA",
    ),
    "main.mod": (
        "MODULE m\n CONST robtarget p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9]];\nENDMODULE\n",
        "tooldata",
    ),
    "move.script": ("def p():\n  movej([0,0,0,0,0,0])\n  # set_tcp(p[0,0,1,0,0,0])\nend\n", "set_tcp"),
    "base.mod": ("MODULE BASE\n" + RAPID.format("tool0", 0, 0, 0), "bare flange"),
    "config.dat": (KRL.format(1, 0.0, 0.0, 1, "") + KRL.format(2, 0.0, 0.0, 2, ""), "bare flange"),
}


def written(folder, name, text):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("name", SEVERAL)
def test_several_tools_without_a_choice_are_refused_with_their_list(name, tmp_path, capsys):
    path = written(tmp_path, name, SEVERAL[name])
    assert run(["export", str(path), "--to", "json"]) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.count("\n") == 1
    assert "tOpen" in said.err and "tLong" in said.err and "--tool" in said.err


@pytest.mark.parametrize("name, by_number", [*product(SEVERAL, (False, True))])
def test_a_tool_is_chosen_by_its_name_or_its_number(name, by_number, tmp_path, capsys):
    number = "4" if name in ("kuka.dat", "fanuc.va") else "3" if name == "abb.mod" else "2"
    path = written(tmp_path, name, SEVERAL[name])
    assert run(["export", str(path), "--tool", number if by_number else "TLONG", "--to", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["name"] == "tLong"
    assert found["tool_mm"][0] == pytest.approx(43.0) and found["tool_mm"][2] == pytest.approx(270.0)


def test_another_name_for_the_controller_does_not_choose_another_tool(tmp_path, capsys):
    path = written(tmp_path, "three.mod", THREE)
    assert run(["export", str(path), "--tool", "tClosed", "--name", "tLong", "--to", "csv"]) == 0
    assert "tLong,0,11,330" in capsys.readouterr().out


def test_a_tool_that_is_not_there_is_refused_with_those_that_are(tmp_path):
    path = written(tmp_path, "three.mod", THREE)
    with pytest.raises(UnknownNameError, match="3 tLong") as seen:
        read_frame(path, tool="tShort")
    assert "three.mod" in str(seen.value)
    with pytest.raises(UnknownNameError):
        read_frame(path, tool="9")


@pytest.mark.parametrize("case", ONE)
def test_what_is_no_tool_is_passed_over(case, tmp_path):
    name, text = ONE[case]
    found = read_frame(written(tmp_path, name, text))
    assert mm(found.pose.position).tolist() == pytest.approx([10.0, 0.0, 150.0])


@pytest.mark.parametrize("name", NONE)
def test_a_file_without_any_tool_says_so(name, tmp_path, capsys):
    text, says = NONE[name]
    path = written(tmp_path, name, text)
    assert run(["export", str(path), "--to", "abb_rapid"]) == 2
    said = capsys.readouterr()
    assert (
        said.out == "" and "no tool frame" in said.err and says in said.err and "column role" not in said.err
    )


def test_the_bare_flange_can_be_asked_for_by_name(tmp_path):
    path = written(tmp_path, "base.mod", "MODULE m\n" + RAPID.format("tool0", 0, 0, 0))
    assert read_frame(path, tool="tool0").pose.position.tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("name", ["abb.mod", "kuka.dat", "ur.script", "fanuc.va"])
def test_a_large_file_is_searched_to_its_end(name, tmp_path):
    comment = {"abb.mod": "! x\n", "kuka.dat": "; x\n", "ur.script": "# x\n", "fanuc.va": "    \n"}[name]
    body = {
        "abb.mod": RAPID.format("tPen", 10, 0, 150),
        "kuka.dat": KRL.format(2, 10.0, 150.0, 2, "tPen"),
        "ur.script": "set_tcp(p[0.01,0,0.15,0,0,0])\n",
        "fanuc.va": MNUTOOL + LISTED.format(2, "tPen", 10.0, 150.0),
    }[name]
    path = written(tmp_path, name, comment * (3_000_000 // len(comment)) + body)
    assert mm(read_frame(path).pose.position).tolist() == pytest.approx([10.0, 0.0, 150.0])


def test_what_is_neither_a_tool_nor_points_is_told_so(tmp_path, capsys):
    path = written(tmp_path, "notes.txt", "x_mm\n1\n")
    assert run(["export", str(path)]) == 2
    assert "no tool frame" in capsys.readouterr().err


def test_comments_in_a_code_page_of_the_controller_do_no_harm(tmp_path):
    path = tmp_path / "t.mod"
    path.write_bytes("! Schweißbrenner für Zelle\n".encode("cp1252") + RAPID.format("t", 1, 2, 3).encode())
    assert mm(read_frame(path).pose.position).tolist() == pytest.approx([1.0, 2.0, 3.0])
    path.write_bytes(("! x\n" + RAPID.format("t", 1, 2, 3)).encode("utf-16"))
    assert mm(read_frame(path).pose.position).tolist() == pytest.approx([1.0, 2.0, 3.0])


def test_a_file_beyond_ten_megabytes_is_refused_by_its_size(tmp_path):
    path = written(tmp_path, "t.mod", " " * 10_000_001)
    with pytest.raises(FileFormatError, match="too large"):
        read_frame(path)
