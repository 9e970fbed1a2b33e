import numpy as np
import pytest

from app.geometry import Pose
from app.kinematics import Contact
from app.kinematics.shapes import ball, box


@pytest.mark.parametrize("gap", [0.3, 0.01, -0.02])
def test_the_distance_of_a_carried_ball_from_a_box_is_signed(gap):
    contact = Contact([ball((0.0, 0.0, 0.1), 0.05)], [box((1.0, 1.0, 0.2), (0.0, 0.0, -0.1))])
    pose = Pose.of(None, np.array([0.2, 0.1, gap - 0.05]))
    assert contact.distance(pose) == pytest.approx(gap, abs=1e-6)


def test_nothing_carried_is_infinitely_far():
    assert Contact([], [ball((0.0, 0.0, 0.0), 1.0)]).distance(Pose.identity()) == np.inf
