"""An eye from which all of something is seen, in a window of any shape."""

import numpy as np
import pytest

from app.scene.camera import _FIELD, framed

FILL = 0.8


@pytest.mark.parametrize("aspect", [0.4, 0.64, 0.86, 1.5, 2.5])
def test_all_points_are_seen_and_the_farthest_out_is_at_the_edge(aspect):
    points = np.random.default_rng(3).normal(size=(50, 3)) * [1.0, 0.4, 0.7] + [2.0, 0.0, 1.0]
    eye, centre = framed(points, np.array([1.0, -0.8, 0.55]), aspect, FILL)
    ahead = (centre - eye) / np.linalg.norm(centre - eye)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    seen = points - eye
    depth = seen @ ahead
    assert (depth > 0).all()
    half = np.tan(_FIELD / 2.0)
    out = (
        np.maximum(np.abs(seen @ right) / (half * aspect), np.abs(seen @ np.cross(right, ahead)) / half)
        / depth
    )
    assert out.max() == pytest.approx(FILL)
