"""Where a result is looked at nothing is cut off: not the arm, which its last stroke has lifted, nor the words."""

import numpy as np
import pytest

from app.scene import camera
from app.scene.eyes import Eyes
from app.screens._tool.paper import PAPER
from app.session.actions import Calculate
from app.session.points import load_action
from app.units import from_deg

#: Where the arm stands after the strokes that the pendant proposes: its elbow is far above the spike.
LIFTED_DEG = np.array([-4.76, 2.93, 41.82, 19.77, 38.26, -103.6])
ABOVE = 0.2  # of the reach: an elbow with its motors is so much higher than its axis
RIM = 0.885  # of the window: arms have motors and hoses farther out than that


def on_page(eye, centre, points, aspect):
    """(n, 2) of the window's half width and half height."""
    ahead = (centre - eye) / np.linalg.norm(centre - eye)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    seen = np.asarray(points) - eye
    half = np.tan(camera._FIELD / 2.0) * (seen @ ahead)
    return np.stack([seen @ right / (half * aspect), seen @ np.cross(right, ahead) / half], axis=1)


def seen(desk, words, aspect):
    """What the window has to show of a result, of its half width and half height."""
    desk.does(lambda: desk.context.stage.view("result"))
    looks = desk.context.stage._server.initial_camera
    joints = desk.context.model.chain.frames(desk.q[None]).joint_positions[0]
    above = joints + np.array([0.0, 0.0, ABOVE * float(desk.context.model.description["reach_m"])])
    eye, centre = np.asarray(looks.position), np.asarray(looks.look_at)
    right = np.cross(centre - eye, [0.0, 0.0, 1.0])
    corners = desk.context.stage._words.corners(right / np.linalg.norm(right))
    assert len(corners) >= words
    points = [np.zeros(3), *joints, *above, desk.context.world.p_base_spike_drawn, *corners]
    return on_page(eye, centre, points, aspect)


@pytest.mark.parametrize("aspect", [0.5, 0.86, 1.6])
def test_arm_spike_and_words_are_in_the_window(sit_at, monkeypatch, aspect):
    monkeypatch.setattr(Eyes, "aspect", aspect)
    desk = sit_at(robot="jby50")
    desk.place(from_deg(LIFTED_DEG))
    assert np.abs(seen(desk, 0, aspect)).max() < RIM
    context = desk.context
    desk.does(lambda: (context.do(load_action(PAPER, method="pairwise")), context.do(Calculate())))
    assert np.abs(seen(desk, 12, aspect)).max() < RIM


def test_what_was_framed_before_a_page_was_there_is_framed_for_its_window(sit_at, monkeypatch):
    """At 1024 x 768 the arm's head began under the keys, and its back outside the window."""
    desk = sit_at(robot="jby50")
    server, stage = desk.context.stage._server, desk.context.stage
    usual = np.linalg.norm(np.subtract(server.initial_camera.position, server.initial_camera.look_at))
    monkeypatch.setattr(Eyes, "aspect", 0.5)
    monkeypatch.setattr(Eyes, "known", True)
    desk.does(server.sized)
    looks = server.initial_camera
    narrow = np.linalg.norm(np.subtract(looks.position, looks.look_at))
    assert narrow == pytest.approx(2.0 * usual)
    monkeypatch.setattr(Eyes, "aspect", 1.0)
    desk.does(server.sized)  # another page: what was framed for one stays
    assert np.linalg.norm(np.subtract(looks.position, looks.look_at)) == pytest.approx(narrow)
    assert stage._seen_from == "whole"
