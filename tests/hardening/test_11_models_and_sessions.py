"""Models and sessions of any content: an answer, or one line that says which part cannot be."""

import json
import os

import pytest

from app.cli import run
from app.session import Store
from app.session.actions import ChooseRobot
from app.session.journal import FORMAT

HEADER = {"session": "0" * 32, "created": 1.0, "format": FORMAT}
ROBOT = {"do": "choose_robot", "robot": "ur10e"}
POSES = [[1.0, 0, 0, 0, 0, 0], [1.0, 0.1, 0, 0.5, 0, 0], [1, 0, 0.1, 0, 0.5, 0], [1, 0, 0, 0, 0, 0.5]]
LOAD = {
    "do": "load_points", "source": "s", "title": "t", "mode": "touch", "method": "joint", "roles": ["touch"] * 4,
    "rows": [1, 2, 3, 4], "columns": ["x", "y", "z", "a", "b", "c"], "values": POSES, "steps": [0.0] * 6,
    "angles": "ZYX",
}  # fmt: skip
BEGIN = {
    "do": "begin",
    "exercise": "first_tool",
    "seed": 3,
    "at": 1.0,
    "robot": "ur10e",
    "mode": "touch",
    "touches": 4,
}


def nested(depth):
    value = 1
    for _ in range(depth):
        value = [value]
    return value


def effect(name="joint_compliance", where=None, **parameters):
    return {
        "effect": name,
        "where": {"joint": 2} if where is None else where,
        "parameters": parameters or {"compliance": 1e-6},
    }


def saved(*effects, **changes):
    return {
        "format": "teachframe.model/1",
        "kind": "static",
        "robot": "ur10e",
        "effects": list(effects),
        **changes,
    }


MODELS = {
    "a joint that is no whole number": saved(effect(where={"joint": 2.7})),
    "joint 0": saved(effect(where={"joint": 0})),
    "joint -1": saved(effect(where={"joint": -1})),
    "joint 7 of six": saved(effect(where={"joint": 7})),
    "joint true": saved(effect(where={"joint": True})),
    "joint as a text": saved(effect(where={"joint": "2"})),
    "no joint": saved(effect(where={})),
    "no parameter": saved({**effect(), "parameters": {}}),
    "a parameter of 1e308": saved(effect(compliance=1e308)),
    "a mass below zero": saved(
        effect("payload", {"body": "tool"}, mass=-3.0, com_x=0.0, com_y=0.0, com_z=0.0)
    ),
    "where within where": saved(effect(where={"joint": 2, "a": {"b": nested(300)}})),
    "a kind nobody has": saved(effect(), kind="sideways"),
    "five thousand effects": saved(*[effect()] * 5000),
    "effects as a number": saved(effects=3),
    "a robot nobody has": saved(effect(), robot="/etc/passwd"),
    "deep brackets": "[" * 100_000,
    "another format": {"format": "teachframe.model/9", "kind": "static", "robot": "ur10e"},
}
SESSIONS = {
    "created in the year 1e300": [{**HEADER, "created": 1e300}, ROBOT],
    "created never": [{**HEADER, "created": -1.0}, ROBOT],
    "columns that repeat": [HEADER, ROBOT, {**LOAD, "columns": ["x"] * 6}],
    "columns of another kind": [HEADER, ROBOT, {**LOAD, "columns": ["q1", "q2", "q3", "q4", "q5", "q6"]}],
    "rows of another length": [HEADER, ROBOT, {**LOAD, "values": [row[:5] for row in POSES]}],
    "fewer rows than roles": [HEADER, ROBOT, {**LOAD, "rows": [1]}],
    "joints of one number": [HEADER, ROBOT, {**LOAD, "robot": "ur10e", "joints": [[0.0]] * 4}],
    "a place of 1e308": [HEADER, ROBOT, {**LOAD, "values": [[1e308] * 6, *POSES[1:]]}],
    "a convention nobody has": [HEADER, ROBOT, {**LOAD, "angles": "QQQ"}],
    "a role nobody has": [HEADER, ROBOT, {**LOAD, "roles": ["<b>"] * 4}],
    "an exercise nobody has": [HEADER, ROBOT, {**BEGIN, "exercise": "../../etc/passwd"}],
    "a seed below zero": [HEADER, ROBOT, {**BEGIN, "seed": -1}],
    "a tool that is no pose": [HEADER, ROBOT, {**BEGIN, "tools": [["t", [0.0] * 16]]}],
    "a cell seed below zero": [HEADER, ROBOT, {"do": "open_cell", "first": "ur10e", "second": "ur5", "seed": -5}],
    "a model of 1e308": [HEADER, ROBOT, {"do": "use_model", "model": saved(effect(compliance=1e308))}],
    "a model that bends the arm by kilometres": [
        HEADER, ROBOT,
        {"do": "use_model", "model": saved(effect("link_length", {"link": 2, "axis": "a"}, offset=1e4))},
    ],
    "a note of a megabyte": [HEADER, ROBOT, {"do": "comment", "step": "touch1", "text": "a" * 1_000_000}],
    "an action that is none": [HEADER, {"do": "explode"}],
    "deep brackets": "[" * 100_000,
}  # fmt: skip


def refused(argv, capsys):
    assert run([str(a) for a in argv]) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.count("\n") == 1 and "internal" not in said.err, said.err
    return said.err


@pytest.mark.parametrize("name", MODELS)
def test_a_model_that_cannot_be_is_refused_in_one_line(name, tmp_path, capsys):
    path = tmp_path / "m.json"
    path.write_text(MODELS[name] if isinstance(MODELS[name], str) else json.dumps(MODELS[name]))
    if name not in ("no parameter",):  # what is missing is left out of the description and told
        assert (
            "m.json" in refused(["export-model", path, "--to", "urdf", tmp_path / "o.urdf"], capsys)
            or "joint" in name
        )
    if name == "a robot nobody has":  # the arm named on the command line counts
        return
    argv = [
        "simulate",
        "--robot",
        "ur10e",
        "--kind",
        "touch",
        "--samples",
        "20",
        "--model",
        path,
        tmp_path / "o.csv",
    ]
    refused(argv, capsys)
    assert not (tmp_path / "o.csv").exists()


@pytest.mark.parametrize("name", SESSIONS)
def test_a_session_that_cannot_be_is_refused_in_one_line_and_not_taken_in(name, tmp_path, capsys):
    path = tmp_path / "s.jsonl"
    lines = SESSIONS[name]
    if isinstance(lines, list):
        entries = [{"n": n, "t": 1.0, "action": action} for n, action in enumerate(lines[1:], 1)]
        lines = "\n".join(json.dumps(line) for line in (lines[0], *entries))
    path.write_text(lines + "\n")
    assert "s.jsonl" in refused(["replay", path], capsys)
    refused(["sessions", "--take", path, "--data", tmp_path / "data"], capsys)
    assert run(["sessions", "--data", str(tmp_path / "data")]) == 0
    assert "no sessions" in capsys.readouterr().out


def test_a_session_with_a_time_that_no_calendar_has_does_not_stop_the_list(tmp_path, capsys):
    from sqlalchemy import update

    from app.session.database import SESSIONS as TABLE

    store = Store(tmp_path)
    names = [store.create(robot="ur10e").name for _ in range(2)]
    with store.database.begin() as connection:
        connection.execute(update(TABLE).where(TABLE.c.name == names[0]).values(created=1e300))
    assert run(["sessions", "--data", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert all(name[:12] in said for name in names) and "?" in said


@pytest.mark.parametrize("option", ["--model", "--robot", "file"])
@pytest.mark.parametrize("kind", ["fifo", "zero", "folder", "long"])
def test_what_is_no_regular_file_is_refused_at_once(option, kind, tmp_path, capsys):
    path = tmp_path / "thing"
    if kind == "fifo":
        os.mkfifo(path)
    elif kind == "folder":
        path.mkdir()
    elif kind == "zero":
        path = "/dev/zero"
    else:
        path = tmp_path / ("a" * 300)
    arguments = {
        "--model": ["simulate", "--robot", "ur10e", "--kind", "touch", "--model", path, tmp_path / "o.csv"],
        "--robot": ["simulate", "--robot", path, "--kind", "touch", tmp_path / "o.csv"],
        "file": ["replay", path] if kind != "folder" else ["export", path],
    }
    refused(arguments[option], capsys)


@pytest.mark.parametrize("kind", ["fifo", "device", "link", "folder", "long"])
def test_results_replace_regular_files_only(kind, tmp_path, capsys):
    out = tmp_path / "out.json"
    kept = tmp_path / "kept"
    kept.write_text("mine")
    if kind == "fifo":
        os.mkfifo(out)
    elif kind == "link":
        out.symlink_to(kept)
    elif kind == "folder":
        out.mkdir()
    elif kind == "device":
        out = "/dev/null"
    else:
        out = tmp_path / ("b" * 300)
    tool = tmp_path / "t.script"
    tool.write_text("set_tcp(p[0,0,0.1,0,0,0])")
    refused(["export", tool, "--to", "json", "--out", out], capsys)
    refused(["simulate", "--robot", "ur10e", "--kind", "touch", "--samples", "20", out], capsys)
    assert kept.read_text() == "mine"


@pytest.mark.parametrize(
    "argv",
    [
        ["--seed", "-1"], ["--repeats", "-3"], ["--noise-mm", "nan"], ["--noise-mm", "inf"], ["--noise-mm", "-1"],
        ["--samples", "0"], ["--targets", "0"], ["--loads-kg", "inf"],
    ],
)  # fmt: skip
def test_numbers_that_no_recording_can_be_made_with_are_refused(argv, tmp_path, capsys):
    refused(["simulate", "--robot", "ur10e", "--kind", "touch", *argv, tmp_path / "o.csv"], capsys)


def test_an_infinite_centre_of_mass_is_refused(tmp_path, capsys):
    tool = tmp_path / "t.script"
    tool.write_text("set_tcp(p[0,0,0.1,0,0,0])")
    refused(["export", tool, "--com-mm", "inf", "0", "0"], capsys)


def test_what_moves_a_terminal_does_not_reach_it(tmp_path, capsys):
    path = tmp_path / "p.csv"
    body = "".join(f"touch,{900 + 30 * k},{20 * k},400,{25 * k},{10 * k},{-20 * k}\n" for k in range(5))
    path.write_text(
        "# kind: points\n# angles: ZYX\n# title: \x1b[2Jx\n# note: a\x9bb\n"
        f"role,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg\n{body}"
    )
    code = run(["solve", str(path)])
    said = capsys.readouterr()
    assert code in (0, 2)
    assert "\x1b" not in said.out + said.err and "\x9b" not in said.out + said.err


def test_actions_of_a_sound_session_are_still_done():
    from app.session import Session

    session = Session()
    session.do(ChooseRobot("ur5"))
    assert session.state.robot == "ur5"
