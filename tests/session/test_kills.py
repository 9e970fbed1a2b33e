"""A real process that teaches, killed with -9 at a moment nobody chose, a hundred times."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np

from app.session import Store
from app.session.actions import Move

KILLS, EACH, LONGEST_S = 100, 10, 0.04  # a new session after each ten, so that none grows long
PATIENCE_S = 300.0

#: Imports and reads the arm once; every line on its stdin is a process of its own that opens the session and never
#: stops by itself.
TEACHER = """
import os, sys
from pathlib import Path
from app.session import Store
from app.session.actions import Delete, Move, Record
from app.session.reducer import reduce
from app.session.state import first_state
state = first_state("ur10e")
for action in (Record("touch1"), Delete("touch1")):
    state = reduce(state, action)
for line in sys.stdin:
    name = line.strip()
    child = os.fork()
    if child:
        os.waitpid(child, 0)
        print("dead", flush=True)
        continue
    os.write(1, f"child {os.getpid()}\\n".encode())
    session = Store(Path(sys.argv[1])).open(name)
    q = session.state.q
    while True:
        q = (q[0] + 1e-4, *q[1:])
        taught = "touch1" in session.state.captures
        for action in (Move(q), Delete("touch1") if taught else Record("touch1", q)):
            count = session.do(action).count
            os.write(1, f"{count} {q[0]!r}\\n".encode())
"""


def test_nothing_confirmed_is_lost_in_a_hundred_random_kills(tmp_path):
    rng = np.random.default_rng(int(time.time()))
    teacher = subprocess.Popen(
        [sys.executable, "-c", TEACHER, str(tmp_path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        cwd=Path.cwd(),
    )
    assert teacher.stdin is not None and teacher.stdout is not None
    watch = threading.Timer(PATIENCE_S, teacher.kill)
    watch.start()
    store = Store(tmp_path)
    total, name, reached = 0, "", 1
    for kill in range(KILLS):
        if kill % EACH == 0:
            name, reached = store.create(robot="ur10e").name, 1
        print(name, file=teacher.stdin, flush=True)
        child = int(teacher.stdout.readline().split()[1])
        said = [teacher.stdout.readline()]  # it works; now at any moment
        time.sleep(float(rng.uniform(0.0, LONGEST_S)))
        os.kill(child, signal.SIGKILL)
        while (line := teacher.stdout.readline()) != "dead\n":
            assert line, "the teaching process ended by itself"
            said.append(line)
        count, angle = said[-1].split()
        state = store.state(name)
        assert state.count >= int(count) > reached
        if state.count == int(count):
            assert state.q[0] == float(angle)
        total, reached = total + state.count - reached, state.count
    watch.cancel()
    teacher.stdin.close()
    teacher.wait()
    assert total > 2 * KILLS
    session = store.open(name)
    assert session.do(Move(session.state.q)).count == reached + 1
