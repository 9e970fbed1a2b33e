"""`teachframe serve --workers` killed with -9, all of it at once, while somebody teaches: what was confirmed stays.

Run: python -m tests.hardening.tree_kills KILLS [FOLDER]
"""

import sys
import tempfile
import threading
import time
from pathlib import Path

import numpy as np

from app.session import Store
from app.session.owners import Owners, owner_of
from tests.shell.started import Started
from tests.shell.test_server_kills import LONGEST_S, Teacher
from tests.shell.test_workers import arrived


def kill_trees(folder, kills, workers=2):
    """Kills supervisor, front and workers together at random moments in the midst of teaching.

    Returns:
        How much the page had confirmed, and the longest time [s] from a new tree's address to the person's points.
    """
    rng = np.random.default_rng(int(time.time()))
    teacher, cookie, longest = Teacher(rng), None, 0.0
    store = Store(folder)
    for _ in range(kills):
        with Started(folder, "--workers", str(workers)) as tree:
            begun = time.monotonic()
            hand = arrived(tree.port, cookie)
            cookie = hand.cookie
            shown = {step: angle is not None for step, angle in teacher.confirmed.items()}
            assert hand.wait_for(lambda hand=hand, shown=shown: shown.items() <= hand.rows().items())
            longest = max(longest, time.monotonic() - begun)
            assert hand.wait_for(lambda hand=hand: bool(hand.read))
            kill = threading.Timer(float(rng.uniform(0.0, LONGEST_S)), tree.kill)
            teacher.teach(hand, kill.start)
            assert hand.gone.wait(10.0)
            kill.join()
            hand.close()
        session = Owners(store.database).latest(owner_of(cookie.split("=", 1)[1]))
        teacher.found(store.state(session))
    store.database.close()
    return teacher.count, longest


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as own:
        count, longest = kill_trees(Path(sys.argv[2]) if len(sys.argv) > 2 else Path(own), int(sys.argv[1]))
    print(
        f"{sys.argv[1]} kills of the whole tree: {count} points confirmed, none lost; back within {longest:.1f} s"
    )
