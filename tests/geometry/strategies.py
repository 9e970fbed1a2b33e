"""Rotations and poses to try, the awkward ones included: near the identity, near half a turn."""

import numpy as np
from hypothesis import strategies as st

from app.geometry import Pose, exp_so3

PI = float(np.pi)
ANGLES = st.one_of(
    st.floats(0.0, PI),
    st.sampled_from([0.0, 1e-300, 1e-16, 1e-12, 1e-9, 1e-8, 1e-7, 1e-5, 1e-3, PI / 2]),
    st.sampled_from([PI, PI - 1e-15, PI - 1e-12, PI - 1e-9, PI - 1e-8, PI - 1e-6, PI - 1e-4]),
)
COMPONENT = st.one_of(st.floats(-1.0, 1.0), st.sampled_from([0.0, 1.0, -1.0]))


@st.composite
def directions(draw):
    """Unit vectors, the axes among them."""
    vector = np.array([draw(COMPONENT) for _ in range(3)])
    length = np.linalg.norm(vector)
    return vector / length if length > 1e-3 else np.array([0.0, 0.0, 1.0])


@st.composite
def rotation_vectors(draw):
    """Angle 0..pi about any direction."""
    return draw(ANGLES) * draw(directions())


@st.composite
def rotations(draw):
    return exp_so3(draw(rotation_vectors()))


@st.composite
def poses(draw):
    position = np.array([draw(st.floats(-5.0, 5.0)) for _ in range(3)])
    return Pose.of(draw(rotations()), position)
