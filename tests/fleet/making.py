"""Small recordings, rows and workers without processes, for the tests of a fleet."""

from datetime import UTC, datetime

import msgspec

from app.fleet.keys import program
from app.fleet.work import Row, work
from app.proof.generator.simulate import simulate_static
from app.proof.generator.static.plan import Plan

DAY = 86400.0
FIRST = datetime(2026, 1, 5, tzinfo=UTC).timestamp()


def recording(path, seed=0, effect="joint_compliance:joint=2,compliance=3e-5"):
    """A tracker recording of a ur5 with one effect."""
    path.parent.mkdir(parents=True, exist_ok=True)
    simulate_static("ur5", Plan(kind="tracker", samples=20, noise=1.5e-4), [effect], seed, path)
    return path


class Here:
    """Does the work in this process, and remembers which."""

    def __init__(self, settings, after=None):
        self.settings, self.worked, self._after = settings, [], after

    def rows(self, jobs):
        for job in jobs:
            self.worked.append(job.file)
            yield work(job, self.settings, program())
            if self._after is not None and len(self.worked) == self._after:
                raise KeyboardInterrupt

    def close(self):
        pass


def row(arm, day=0.0, *, run=1, value=3e-5, std=1e-6, effect="joint_compliance", joint=2, error=""):
    """A row as a ledger holds it; `effect` None is a clean recording."""
    findings = [
        {
            "effect": effect,
            "where": {"joint": joint, "driver": "gravity_torque", "from_row": 7},
            "parameters": [{"name": "compliance", "value": value, "std": std, "unit": "rad/Nm"}],
        }
    ]
    told = {"findings": [] if effect is None else findings}
    return Row(
        f"{arm}/{day}.csv",
        "key",
        run=run,
        arm=arm,
        recorded=FIRST + day * DAY,
        verdict="clean" if effect is None else "named",
        diagnosis="" if error else msgspec.json.encode(told).decode(),
        error=error,
        reason="input" if error else "",
    )
