"""Arms that people brought: packed without loss, kept with the sessions, in backups, replayed by the command line."""

import gc
import json

import numpy as np
import pytest

from app.cli import run
from app.errors import FileFormatError, UnknownNameError
from app.kinematics import load_robot
from app.kinematics.packing import packed
from app.kinematics.solids import missing_meshes, robot_shapes
from app.people import People
from app.people.belongings import erase, everything
from app.session import Store
from app.session.actions import ChooseRobot
from app.session.arms import PIECES, Arms, Packed, unpacked_arm
from app.session.backup import back_up, restore
from app.session.database import Database, sqlite_url
from app.session.state import as_tuple, robot_named
from tests.own_arm import TITLE, text, zipped
from tests.session.wizard import wizard_actions


@pytest.fixture
def robot(tmp_path):
    return load_robot(zipped(tmp_path))


@pytest.fixture
def arm(robot):
    return Packed(TITLE, f"{robot.base}..{robot.flange}", packed(robot))


def test_what_is_packed_is_the_same_arm_and_packed_again_the_same_bytes(tmp_path, robot, arm):
    again = load_robot(unpacked_arm(arm, tmp_path))
    assert again.flange == robot.flange and missing_meshes(again) == ()
    for q in np.random.default_rng(0).uniform(-2.0, 2.0, (5, 6)):
        np.testing.assert_array_equal(again.flange_matrix(q), robot.flange_matrix(q))
    old, new = robot_shapes(robot), robot_shapes(again)
    assert [(s.kind, s.body, s.size) for s in new] == [(s.kind, s.body, s.size) for s in old]
    np.testing.assert_allclose(np.ptp(new[0].mesh.hull, axis=0), np.ptp(old[0].mesh.hull, axis=0), atol=1e-6)
    assert packed(robot) == arm.content and len(arm.content) < 20_000
    assert Packed(TITLE, "a..b", arm.content).name != arm.name  # another part of it is another arm


def test_it_is_kept_for_one_person_backed_up_taken_along_and_erased(tmp_path, arm):
    store = Store(tmp_path / "data")
    people = People(store.database)
    people.add("ada", "Ada", "administrator", "correct horse battery")
    tom = people.add("tom", "Tom", "trainee", "correct horse battery")
    arms = Arms(store.database)
    name = arms.keep(tom.owner, arm)
    assert arms.keep(tom.owner, arm) == name  # twice the same is once
    assert arms.of(tom.owner) == {name: TITLE} and arms.of("somebody else") == {}
    assert robot_named(name).title == TITLE
    back_up(store.database, tmp_path / "b.sqlite")
    other = Database(sqlite_url(tmp_path / "other.sqlite"))
    restore(tmp_path / "b.sqlite", other)
    assert Arms(other).model(name).joint_count == 6
    assert b"arm_pieces.jsonl" in everything(people, tom, "ada")
    erase(people, tom, "ada")
    assert Arms(store.database).of(tom.owner) == {}
    with pytest.raises(UnknownNameError):
        Arms(store.database).model(name)


def test_what_is_damaged_is_told(tmp_path, arm):
    store = Store(tmp_path)
    name = Arms(store.database).keep("x", arm)
    with store.database.begin() as connection:
        connection.execute(PIECES.update().values(piece=b"PK"))
    with pytest.raises(FileFormatError, match="damaged"):
        Arms(store.database).model(name)


def test_the_command_line_replays_a_session_with_it(tmp_path, arm, capsys):
    store = Store(tmp_path / "data")
    name = Arms(store.database).keep("x", arm)
    session = store.create(robot=name)
    for action in wizard_actions()[0]:
        if not isinstance(action, ChooseRobot):
            session.do(action)
    session.close()
    assert run(["replay", session.name[:8], "--data", str(tmp_path / "data")]) == 0
    own = capsys.readouterr().out
    assert "tool point in the flange [mm]" in own
    (tmp_path / "s.jsonl").write_bytes(store.export(session.name))
    assert run(["sessions", "--take", str(tmp_path / "s.jsonl"), "--data", str(tmp_path / "data")]) == 0
    capsys.readouterr()


def test_elsewhere_its_description_stands_for_it(tmp_path, capsys):
    """A fresh process knows nothing of the arm: the session is refused in a line that names it, or --robot gives it."""
    from tests.hardening.small import ran

    robot = load_robot("ur10e")
    name = "bent~0123456789abcdef"
    actions = [{"do": "choose_robot", "robot": name}, {"do": "move", "q": as_tuple(robot.home)}]
    lines = [{"session": "0" * 32, "created": 1.0, "format": "teachframe.session/1"}]
    lines += [{"n": n, "t": 1.0, "action": action} for n, action in enumerate(actions, 1)]
    (tmp_path / "s.jsonl").write_text("\n".join(map(json.dumps, lines)) + "\n")
    (tmp_path / "arm.urdf").write_text(text())
    got = ran("replay", "s.jsonl", folder=tmp_path)
    assert got.code == 2 and got.err.count("\n") == 1 and name in got.err
    got = ran("replay", "s.jsonl", "--robot", "arm.urdf", folder=tmp_path)
    assert got.code == 0 and "arm" in got.out


def test_a_model_is_drawn_after_the_store_it_came_from_is_gone(tmp_path, arm):
    arms = Arms(Store(tmp_path / "data").database)
    model = arms.model(arms.keep("tom", arm))
    del arms
    Arms(Store(tmp_path / "other").database).keep(
        "tom", arm
    )  # of another store of this process: sessions use this one
    gc.collect()
    assert missing_meshes(model) == () and "mesh" in {shape.kind for shape in robot_shapes(model)}
