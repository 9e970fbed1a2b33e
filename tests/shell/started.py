"""`teachframe serve` in a process of its own, as people start it."""

import contextlib
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path


class Started:
    """The server and all its processes; leaving the `with` kills whatever is left of them.

    Args:
        folder: the data folder.
        options: further words of the command line.

    Attributes:
        process: the one that was started; port: where it listens; said: lines of its stderr.
    """

    def __init__(self, folder, *options):
        command = [sys.executable, "-m", "app", "serve", "--port", "0", "--robot", "ur10e"]
        # A session of its own: all of it can be killed at once.
        self.process = subprocess.Popen(
            [*command, "--data", str(folder), *options],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        self.said = []
        self._hearing = threading.Thread(target=lambda: self.said.extend(self.process.stderr), daemon=True)
        self._hearing.start()
        line = self.process.stdout.readline()
        if not line.startswith("Teachframe pendant: http"):
            self.kill()
            raise RuntimeError(f"the server did not start: {line} {self.said}")
        self.port = int(line.rsplit(":", 1)[1])

    @property
    def address(self):
        return f"http://127.0.0.1:{self.port}"

    def workers(self):
        """Processes that serve behind the front (not multiprocessing's own helper)."""
        forker = next((p for p in children(self.process.pid) if b"forkserver" in command_of(p)), None)
        return [] if forker is None else children(forker)

    def stop(self):
        """Ends it as a service manager does."""
        self.process.terminate()
        self.process.wait(timeout=60)

    def kill(self):
        """Kills all of it at once, without a chance to tidy up."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self._hearing.join(timeout=10)
        self.process.stdout.close()
        self.process.stderr.close()

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.kill()


def children(pid):
    """Processes that a process has started."""
    try:
        return [
            int(child)
            for thread in Path(f"/proc/{pid}/task").iterdir()
            for child in (thread / "children").read_text(encoding="ascii").split()
        ]
    except FileNotFoundError:  # it has just ended
        return []


def command_of(pid):
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes()
    except FileNotFoundError:
        return b""
