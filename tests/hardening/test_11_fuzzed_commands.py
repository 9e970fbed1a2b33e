"""Twenty thousand made-up files through whole commands: an answer, or one of the project's own errors in one line.

`make fuzz` runs a million with seeds of its own. An input that failed is made again by its kind, seed and place:
`fuzz` names them.
"""

import tempfile
from pathlib import Path

import numpy as np
import pytest

from tests.hardening.fuzz.running import KINDS, Kind, complaint, fuzz

INPUTS = 20_000
SHARED_MEMORY = Path("/dev/shm")  # opening a file on a disk takes longer than reading it


@pytest.fixture
def folder():
    with tempfile.TemporaryDirectory(dir=SHARED_MEMORY if SHARED_MEMORY.is_dir() else None) as name:
        yield Path(name)


# Two halves, for two cores: not on one as other tests of a file.
@pytest.mark.parametrize(
    "seed", [pytest.param(seed, marks=pytest.mark.xdist_group(f"fuzz {seed}")) for seed in (20240, 20241)]
)
def test_no_made_up_file_ends_in_a_fault_a_hang_or_nan(seed, folder):
    counts, complaints = fuzz(INPUTS // 2, seed, folder)
    assert not complaints, "\n".join(complaints)
    assert sum(counts.values()) >= INPUTS // 2


def test_most_kinds_of_made_up_files_get_past_the_first_check(folder):
    """A fuzzer whose files are all refused at once examines nothing."""
    from app.errors import TeachframeError

    for kind in KINDS:
        answered = 0
        for place in range(60):
            path = folder / f"x{kind.suffix[place % len(kind.suffix)]}"
            path.write_bytes(kind.make(np.random.default_rng([7, place])))
            try:
                kind.command(path, folder / "out")
            except TeachframeError:
                continue
            answered += 1
        assert answered >= 3, kind.name


@pytest.mark.parametrize(
    "does, says",
    [
        (lambda path, out: {}["x"], "KeyError"),
        (lambda path, out: print('{"a": NaN}'), "NaN in JSON"),
        (lambda path, out: next(iter(())), "StopIteration"),
    ],
)
def test_the_fuzzer_sees_what_it_looks_for(does, says, folder):
    kind = Kind("x", 1.0, (".x",), lambda rng: b"", does)
    assert says in complaint(kind, b"", folder, ".x")
