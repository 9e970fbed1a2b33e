"""What a file names is opened only where it belongs to that file; nothing of anything else is quoted."""

import json

import pytest

from app.cli import run
from app.errors import UnknownNameError
from app.kinematics import load_robot, robot_names
from app.kinematics.named import robot_of_file
from app.resources import ROBOTS
from app.session.journal import FORMAT

SECRET = "root:x:0:0"
POINTS = "# kind: points\n# robot: {}\nrole,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n" + "".join(
    f"touch,{10 * k},-60,{60 + 7 * k},{5 * k},{50 - 9 * k},{20 * k}\n" for k in range(5)
)
ELSEWHERE = [
    "/etc/passwd",
    "../../etc/passwd",
    "../../../../../../etc/passwd",
    "/dev/zero",
    "secret.txt",
    "a\0b",
]


@pytest.fixture
def place(tmp_path):
    folder = tmp_path / "given" / "run"
    folder.mkdir(parents=True)
    (tmp_path / "outside.urdf").write_text((ROBOTS / "ur10e" / "robot.urdf").read_text())
    (folder / "secret.txt").write_text(SECRET)
    return folder


@pytest.mark.parametrize("name", ELSEWHERE)
def test_a_session_opens_no_file_that_it_names(name, place, capsys):
    journal = place / "s.jsonl"
    lines = [
        {"session": "0" * 32, "created": 1.0, "format": FORMAT},
        {"n": 1, "t": 1.0, "action": {"do": "choose_robot", "robot": name}},
    ]
    journal.write_text("\n".join(map(json.dumps, lines)) + "\n")
    assert run(["replay", str(journal)]) == 2
    said = capsys.readouterr().err
    assert "unknown robot" in said and SECRET not in said and said.count("\n") == 1


@pytest.mark.parametrize("name", [*ELSEWHERE, "../../outside.urdf"])
@pytest.mark.parametrize("command", ["solve", "base", "diagnose"])
def test_a_header_opens_no_file_outside_its_folders(command, name, place, capsys):
    path = place / "points.csv"
    kind = {"solve": "points", "base": "tracker", "diagnose": "touch"}[command]
    text = POINTS.format(name.replace("\0", "")).replace("kind: points", f"kind: {kind}")
    columns = {"solve": "role", "base": "x_mm", "diagnose": "target"}[command]
    text = text.replace("role,", f"{columns},").replace("touch,", "1," if command == "base" else "touch,")
    if command == "base":
        text = text.replace("x_mm,", "x_mm,y_mm,z_mm,").replace("\n1,", "\n1,2,3,")
    path.write_text(text)
    assert run([command, str(path)]) == 2
    said = capsys.readouterr().err
    assert SECRET not in said and said.count("\n") == 1 and "robot" in said


def test_whether_a_file_is_there_cannot_be_told_from_the_answer(place):
    answers = set()
    for name in ("/etc/passwd", "/etc/nothing_of_this_name", "../../outside.urdf", "../../inside.urdf"):
        with pytest.raises(UnknownNameError) as seen:
            robot_of_file(name, place / "x.csv")
        answers.add(str(seen.value).replace(name, "NAME").partition("(did")[0])
    assert len(answers) == 1


def test_a_description_beside_the_file_or_in_the_folder_above_is_read(place):
    text = (ROBOTS / "ur10e" / "robot.urdf").read_text()
    for target in (place / "arm.urdf", place.parent / "arm.urdf", place / "deeper" / "arm.urdf"):
        target.parent.mkdir(exist_ok=True)
        target.write_text(text)
    for name in ("arm.urdf", "../arm.urdf", "deeper/arm.urdf"):
        assert robot_of_file(name, place / "x.csv").joint_count == 6
    assert robot_of_file("ur5", place / "x.csv").name == "ur5" in robot_names()


def test_a_link_that_leads_out_is_outside(place, tmp_path):
    (place / "link.urdf").symlink_to(tmp_path / "outside.urdf")
    with pytest.raises(UnknownNameError):
        robot_of_file("link.urdf", place / "x.csv")


def test_what_a_person_types_is_opened_wherever_it_lies(tmp_path):
    path = tmp_path / "outside.urdf"
    path.write_text((ROBOTS / "ur10e" / "robot.urdf").read_text())
    assert load_robot(str(path)).joint_count == 6
