"""The sign of a length or twist between two axes that cross is a matter of the axes, never of rounding."""

from dataclasses import replace

import numpy as np
import pytest

from app.diagnosis.models.kinematic.geometry import AXES, link_axes
from app.kinematics import load_robot

ROUNDING = 1e-9  # m


@pytest.mark.parametrize("name", ["ur10e", "irb120", "iiwa7"])
def test_rounding_turns_no_common_normal_round(name):
    chain = load_robot(name).chain
    rng = np.random.default_rng(3)
    plain = link_axes(chain).vectors
    for _ in range(20):
        shaken = replace(
            chain, translations=chain.translations + rng.normal(0, ROUNDING, chain.translations.shape)
        )
        assert np.allclose(link_axes(shaken).vectors, plain, atol=1e-5)


def test_x_points_from_one_axis_to_the_next_where_they_pass_each_other():
    chain = load_robot("irb120").chain
    axes = link_axes(chain)
    along = np.einsum("ni,ni->n", axes.vectors[:, AXES.index("a")], axes.lengths)
    assert np.all(along > -1e-6)
