"""An arm of one's own, over the wire: dropped, jogged, taught, solved with, there again after the server's end."""

import numpy as np
import pytest
import trimesh

from app.people.limits import ARM
from app.screens._cell import own_arm
from app.session import Store
from app.session.actions import ChooseRobot, Move
from app.session.arms import Arms
from app.session.owners import new_secret, owner_of
from app.session.state import as_tuple, robot_named
from app.workers.hub import Hub
from tests.desk import until
from tests.kinematics.description.making import description, joint, line
from tests.own_arm import MESH, OUTSIDE, TITLE, text, zipped
from tests.session.wizard import wizard_actions
from tests.shell.test_files import send, upload_of

DROP = "Drop a description"


def drop(page, content, name, patience=60.0):
    """Sends a description; what was said of it."""
    context = page.live.context
    said = len(context.log)
    assert send(page, upload_of(page, DROP), content=content, name=name).status_code == 204
    until(lambda: any(level != "info" for _, level, _ in context.log[said:]), "the word of it", patience)
    until(lambda: not context.worker._queue, "the worker")
    return context.log[-1][1:]


def brought(page, folder):
    assert drop(page, zipped(folder).read_bytes(), "bent_description.zip") == (
        "good",
        f"{TITLE} stands in the cell: 6 axes, flange flange.",
    )
    return page.live.session.state.robot


def test_it_is_jogged_taught_and_solved_with_like_a_shipped_one(page, tmp_path, patient):
    name = brought(page, tmp_path)
    live = page.live
    assert name.startswith(f"{TITLE}~") and live.context.model.joint_count == 6
    assert any(w.get("label") == "Robot" and w["value"] == TITLE for w in page.state()["widgets"])
    meshes = [s for s in live.context.model.kept["shapes"][0] if s.kind == "mesh"]
    assert [s.link for s in meshes] == ["base"]

    before = page.q
    page.say(t="beat", en=True)
    until(lambda: live.context.drive.live, "the switch")
    page.say(t="beat", en=True, axis=0, sign=1, press=1)
    until(lambda: abs(page.q - before).max() > 0.0, "the jog")
    page.say(t="beat", en=False)
    until(lambda: live.read().how == "standing", "the stand-still")

    actions, _ = wizard_actions("ur10e")
    done = []
    live.context.post(
        lambda: done.extend(live.context.do(a) for a in actions if not isinstance(a, ChooseRobot))
    )
    until(lambda: len(done) == len(actions) - 1, "the wizard")
    shipped = Store(tmp_path / "other").create(robot="ur10e")
    for action in actions:
        shipped.do(action)
    own, same = live.session.state.result.result, shipped.state.result.result
    np.testing.assert_allclose(own.T_flange_tool.matrix, same.T_flange_tool.matrix, atol=1e-9)


def test_another_server_on_the_same_data_has_the_session_and_its_arm(page, hub, tmp_path):
    name = brought(page, tmp_path)
    owner = page.live.context.shelf.owner
    q = page.live.context.model.upper * 0.1
    done = []
    page.live.context.post(lambda: done.append(page.live.context.do(Move(as_tuple(q)))))
    until(lambda: done, "the move")
    hub.close()
    robot_named.cache_clear()
    other = Hub(Store(tmp_path))
    try:
        live = other.enter(owner)
        assert live.session.state.robot == name
        np.testing.assert_allclose(live.context.q, q)
        assert live.context.model.title == TITLE
        assert not str(live.context.model.path).startswith(str(hub.arms._unpacked.path))
    finally:
        other.close()


def test_nobody_else_has_it(page, hub, tmp_path):
    """Not in his list, and no session that he makes up may name it."""
    name = brought(page, tmp_path)
    journal = hub.store.export(page.live.session.name)
    assert name.encode() in journal
    page.client.cookies.clear()
    from tests.shell.conftest import Page

    with Page(page.client, hub) as other:
        assert other.live is not page.live
        label = next(w for w in other.state()["widgets"] if w.get("label") == "Robot")
        assert TITLE not in label["options"]
        said = len(other.live.context.log)
        widget = upload_of(other, "Import a session")
        assert send(other, widget, content=journal, name="s.jsonl").status_code == 204
        until(lambda: len(other.live.context.log) > said, "the refusal")
        level, words = other.live.context.log[-1][1:]
        assert level == "warning" and name in words
    assert Arms(hub.store.database).of(owner_of(new_secret())) == {}


def test_of_two_arms_the_part_is_asked_for_and_can_be_named(page):
    torso = description([*line(6, base="base"), *line(6, base="base", prefix="b")]).encode()
    level, words = drop(page, torso, "torso.urdf")
    assert level == "warning" and "l6" in words and "bl6" in words
    part = next(w["id"] for w in page.state()["widgets"] if w.get("label") == "Which links are the arm")
    page.say(t="press", id=part, value="base..bl6")
    until(lambda: page.live.context.ui.find("Which links are the arm").value == "base..bl6", "the part")
    assert drop(page, torso, "torso.urdf")[0] == "good"
    assert page.live.context.model.flange == "bl6"


def test_how_many_and_how_large_is_limited(page, tmp_path, monkeypatch):
    monkeypatch.setattr(own_arm, "ARMS", 1)
    monkeypatch.setattr(own_arm, "ARM", 1000)
    level, words = drop(page, zipped(tmp_path).read_bytes(), "bent.zip")
    assert level == "warning" and "MB with its meshes" in words
    monkeypatch.setattr(own_arm, "ARM", ARM)
    brought(page, tmp_path)
    level, words = drop(page, zipped(tmp_path).read_bytes(), "bent.zip")
    assert level == "warning" and "1 arms" in words


@pytest.mark.parametrize(
    "name, content",
    [
        ("arm.urdf", b"\x00\x01"),
        ("arm.urdf", b"<robot name='r'/>"),
        ("arm.urdf", description([joint("universe", "base", "l", axis="0 0 0")]).encode()),
        ("arm.urdf", description(line(3)).replace('"0 0 0.1"', '"0 0 1e30"').encode()),
        ("arm.urdf", description(line(3)).replace('"0 0 0.1"', '"0 0 nan"').encode()),
        ("arm.zip", b"PK\x03\x04nothing"),
        ("arm.xacro", b"<robot xmlns:xacro='x' name='r'><xacro:include filename='/etc/passwd'/></robot>"),
        ("arm.stl", b"solid x"),
    ],
)
def test_what_is_no_arm_is_refused_in_a_line_and_the_cell_stays(page, name, content):
    before = page.live.session.state.robot
    level, words = drop(page, content, name)
    assert level == "warning" and "\n" not in words and "root:" not in words
    assert page.live.session.state.robot == before


def test_no_file_outside_the_drop_is_opened_or_written(page, tmp_path):
    outside = text(OUTSIDE)
    level, words = drop(page, zipped(tmp_path, outside).read_bytes(), "bent.zip")
    assert level == "warning" and "Not drawn, 1" in words
    level, words = drop(page, zipped(tmp_path, extra=["../../evil.urdf"]).read_bytes(), "bent.zip")
    assert level == "warning" and "leads out" in words
    trimesh.creation.icosphere(radius=0.05).export(tmp_path / "outside.stl")
    for name in (f"file://{tmp_path}/outside.stl", "../../outside.stl", f"{tmp_path}/outside.stl"):
        level, words = drop(page, zipped(tmp_path, text(name)).read_bytes(), "bent.zip")
        assert level == "warning" and "Not drawn, 1" in words, name
    assert MESH not in page.live.context.model.urdf


def test_one_that_a_session_needs_stays(page, tmp_path):
    name = brought(page, tmp_path)
    context = page.live.context
    context.ui.hear(context.ui.find("Take it away").data.id, None)
    until(lambda: "sessions need this arm" in context.log[-1][2], "the refusal")
    assert name in context.shelf.arms.of(context.shelf.owner)
    arms = context.shelf.arms
    assert arms.used(context.shelf.owner, name) == 1
    store = context.shelf.store
    for listed in store.names():
        store.delete(listed)
    context.ui.hear(context.ui.find("Take it away").data.id, None)
    until(lambda: "is taken away" in context.log[-1][2], f"the word of it; {context.log[-1]}")
    assert arms.of(context.shelf.owner) == {}
