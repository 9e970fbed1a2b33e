"""Recordings with known truth, from a forward model of its own.

Shares no code with the search it examines (tests/test_architecture.py holds it): its own rotations, its own
reading of URDF, its own gravity and Newton-Euler.

rotations.py    rotation matrices and quaternions
arm.py          the arm as arrays, and where its links are
dynamics.py     holding torques and recursive Newton-Euler
urdf.py         reads a description; urdf_writing.py writes one
topologies/     random arms, one file a family
effects/        static/, motion/: one file an effect; outside/: laws that no library holds
static/         touches and tracker points
motion/         joint logs over time
observer.py     what could be learnt from a recording by one who knows how it was made
noise.py        measurement noise and outliers
files.py        the CSV, and the truth beside it
"""
