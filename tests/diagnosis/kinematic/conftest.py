import pytest

from tests.diagnosis.kinematic.arms import write_arm


@pytest.fixture(scope="session")
def arm(tmp_path_factory):
    """A six-axis arm with masses, no two neighbouring axes alike."""
    return write_arm(tmp_path_factory.mktemp("arm") / "arm.urdf")
