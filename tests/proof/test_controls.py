"""Negative controls: recordings in which nothing may be named."""

import pytest

from app.proof.asking import ask
from app.proof.controls import draw_control, named


@pytest.mark.parametrize("index", [0, 4])
def test_touches_whose_names_are_shuffled_name_nothing(tmp_path, index):
    """Five spikes; steps of the base between their blocks would bring them all to one place."""
    control = draw_control(771188, index, "shuffled", tmp_path)
    said = ask(control.path)
    assert said["kind"] == "touch"
    assert not named(said)
    assert said["verdict"] == "unexplained"


def test_the_sign_that_physics_forbids_is_that_of_a_stiffness(tmp_path):
    """Play that is made up for by more than there is has a negative gap, and is a finding."""
    drawn = [draw_control(3, index, "flipped", tmp_path) for index in range(2)]
    assert all(control.truth.startswith("joint_compliance") for control in drawn)
