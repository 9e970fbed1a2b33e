"""How far a recording is read and searched: told step by step, never backwards, no step a large part of the whole."""

from itertools import pairwise

import pytest

from app.diagnosis.dispatch import diagnose_file
from app.recordings.delimited.source import CHUNK
from app.screens._compare.loaded import load
from app.steps import done, listened, part
from tests.cli.running import teachframe

LARGEST = 0.2  # of the whole, between two words
#: Rows of a file that is read in several pieces.
ROWS = {"motion": 30_000, "tracker": 60_000}


@pytest.fixture(scope="module", params=ROWS)
def recording(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("big") / f"{request.param}.csv"
    asked = (
        "--robot",
        "ur10e",
        "--kind",
        request.param,
        "--samples",
        str(ROWS[request.param]),
        "--seed",
        "3",
    )
    said = teachframe("simulate", path, *asked)
    assert said.code == 0, said.err
    assert path.stat().st_size > CHUNK
    return path


def told(work):
    """What is told of some work: [(share, doing)]."""
    said = []
    work(lambda share, doing: said.append((share, doing)))
    return said


def steps(said):
    shares = [0.0, *(share for share, _ in said)]
    assert all(b >= a for a, b in pairwise(shares)), "it goes back"
    assert shares[-1] == 1.0
    return [b - a for a, b in pairwise(shares)]


@pytest.mark.parametrize("work", ["read", "search"])
def test_no_step_is_a_large_part_of_the_whole(recording, work):
    """It stood at 55% for 35 s of 40: rows are read when a column is asked for, and nobody told what followed."""
    by = {
        "read": lambda say: load(recording, progress=say),
        "search": lambda say: diagnose_file(recording, progress=say),
    }
    said = told(by[work])
    assert max(steps(said)) <= LARGEST, said
    moved = [step for step in steps(said) if step > 0.0]
    assert len(moved) >= 8, "a bar that moves a few times stands still in between"


def test_rows_are_told_by_their_bytes(recording):
    said = told(lambda say: load(recording, progress=say))
    pieces = -(-recording.stat().st_size // CHUNK)
    assert len({share for share, doing in said if doing == "reading"}) >= pieces + 5


def test_parts_of_parts_add_up_and_never_fall():
    said = []
    done(0.5)  # nobody listens
    with listened(lambda share, doing: said.append((share, doing)), "reading"):
        with part(0.0, 0.5):
            done(0.5)
            with part(0.5, 1.0, "looking"):
                done(0.5)
            done(0.2)
        done(0.1)
        with pytest.raises(ValueError, match="broken"), part(0.5, 1.0):
            raise ValueError("broken")
    done(1.0)
    assert said == [
        (0.0, "reading"), (0.25, "reading"), (0.25, "looking"), (0.375, "looking"), (0.5, "looking"),
        (0.5, "reading"), (0.5, "reading"), (0.5, "reading"), (0.5, "reading"),
    ]  # fmt: skip
