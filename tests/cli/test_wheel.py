"""The wheel carries what the program reads: robots, static files, every command."""

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def names(tmp_path_factory):
    """What is inside the wheel, built without the network from a copy of nothing but the checkout."""
    out = tmp_path_factory.mktemp("wheel")
    done = subprocess.run(
        [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "-w", str(out), str(ROOT)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    (wheel,) = out.glob("teachframe-*.whl")
    with zipfile.ZipFile(wheel) as archive:
        return set(archive.namelist())


def carried(folder):
    """Files of the checkout under a folder, as git would ship them."""
    return {
        p.relative_to(ROOT).as_posix()
        for p in (ROOT / folder).rglob("*")
        if p.is_file() and "__pycache__" not in p.parts and p.suffix != ".part"
    }


@pytest.mark.parametrize("folder", ["robots", "static"])
def test_the_wheel_carries_the_folder(names, folder):
    files = carried(folder)
    assert files
    assert {f"app/_shipped/{f}" for f in files} <= names


def test_the_wheel_carries_every_module(names):
    assert {f for f in carried("app") if f.endswith(".py")} <= names


def test_the_wheel_carries_no_tests(names):
    assert not any(n.startswith(("tests/", "benchmarks/")) for n in names)
