"""Twice the file takes at most about twice the time, whatever stands in it; a megabyte takes no second.

Each piece begins what some pattern looks for and never ends it, which is what makes a backtracking search quadratic.
"""

import contextlib
import gc
import time

import pytest

from app.calibration.exchange import formats
from app.errors import TeachframeError
from app.recordings import read_table

#: Characters; small enough that a quadratic reader still ends, large enough that it is seen.
SIZE = 120_000
#: Twice the size may take so much longer: 2 for linear, 4 for quadratic; the clock of a busy machine is in between.
MOST_GROWTH = 3.2
#: Below this [s] a time says nothing about growth.
UNSEEN = 0.04
RUNS = 6

PIECES = {
    "digits": "1",
    "blanks": " ",
    "line ends": "\n",
    "quotes": '"',
    "single quotes": "'",
    "names": "a",
    "open brackets": "[",
    "open braces": "{",
    "commas": ",",
    "minus": "-",
    "points": ".",
    "dollars": "${",
    "UTOOL": "UTOOL[",
    "UTOOL with blanks": "UTOOL[ ",
    "set_tcp": "set_tcp(p[",
    "set_tcp and digits": "set_tcp(p[1,",
    "payload": "set_payload(1,[",
    "TOOL_DATA": "TOOL_DATA[1]={",
    "TOOL_NAME": 'TOOL_NAME[1,]="',
    "LOAD": "LOAD_DATA[1]={M 1",
    "$TOOL": "$TOOL =",
    "FRAME": "FRAME a={",
    "tooldata": "tooldata a:=[",
    "tooldata of digits": "tooldata a:=[1",
    "PR": "PR[1:",
    "PR number": "PR[1,1]=1 ",
    "P block": "P[1]{\nX = 1 mm,",
    "six letters": "X: 1 Y: 1 Z: 1 W: 1 P: 1 ",
    "MNUTOOL": "[*SYSTEM*]$MNUTOOL [1,1] = '",
    "static transform": "static_transform_publisher ",
    "named transform": "static_transform_publisher --x 1 ",
    "launch": "<node static_transform_publisher name= args=",
    "joint": '<joint type="fixed"><origin xyz="',
    "units": "Units: ",
    "unit in a name": "x [",
    "header": "# a: ",
    "colons": "a::",
    "json": '{"format":',
}


def took(job):
    """Processor time [s], the collector of garbage kept out of it."""
    gc.disable()  # and nothing is collected before: after a thousand tests that takes longer than the reader
    begun = time.process_time()
    try:
        with contextlib.suppress(TeachframeError):
            job()
        return time.process_time() - begun
    finally:
        gc.enable()


def assert_linear(job_of, piece):
    """`job_of(text)` gives a job. The best of a few runs counts, because others use the machine too; a quadratic
    reader is quadratic in all of them."""
    small, large = (job_of(piece * (size // len(piece))) for size in (SIZE, 2 * SIZE))
    first = second = float("inf")
    for _ in range(RUNS):
        first, second = min(first, took(small)), min(second, took(large))
        if second < max(MOST_GROWTH * first, UNSEEN):
            return
    raise AssertionError(f"{first:.3f} s, twice the size {second:.3f} s")


@pytest.mark.parametrize("name", PIECES)
def test_a_controllers_reader_takes_a_time_that_grows_with_the_file_alone(name):
    for form in formats().values():
        assert_linear(lambda text, form=form: lambda: (form.knows(text), form.read(text)), PIECES[name])


@pytest.mark.parametrize("name", PIECES)
def test_a_recordings_reader_takes_a_time_that_grows_with_the_file_alone(name, tmp_path):
    def job_of(text):
        path = tmp_path / f"{len(text)}.txt"
        path.write_text(text, encoding="utf-8")
        return lambda: read_table(path).load()

    assert_linear(job_of, PIECES[name])
