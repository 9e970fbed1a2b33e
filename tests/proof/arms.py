"""Random arms written to a folder, for the tests of the proof."""

import numpy as np

from app import catalog
from app.proof.generator.urdf_writing import write_arm

TOPOLOGIES = sorted(catalog.members("app.proof.generator.topologies", "TOPOLOGY"))


def random_arm(topology, folder, seed=0):
    """An arm of this family and the path of its description."""
    family = catalog.member("app.proof.generator.topologies", "TOPOLOGY", topology, what="topology")
    arm = family.draw(np.random.default_rng(seed))
    path = folder / f"{topology}_{seed}.urdf"
    write_arm(arm, path)
    return arm, path
