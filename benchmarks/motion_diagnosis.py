"""Joint logs of a six-axis arm: the diagnosis by length, and the fit beneath it against finite differences and FIGAROH.

Run: python -m benchmarks.motion_diagnosis [SAMPLES ...]
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pinocchio as pin  # pyright: ignore[reportMissingImports]  (found through a .pth hook)
import polars as pl

from app.kinematics import load_robot
from app.kinematics.dynamics import inertial_parameters, inverse_dynamics
from app.kinematics.regressor import torque_regressor
from benchmarks.real_static import data_folder
from benchmarks.rows import Row, quickest

LENGTHS = {2_500: 0.5, 6_000: 1.0, 10_000: 1.0, 100_000: 1.5, 1_000_000: 4.0}  # samples -> aim [s]
LONGEST, LONGEST_SECONDS, LONGEST_MB = (
    5_000_000,
    30.0,
    2000.0,
)  # rows, reading and all: promised in docs/limits.md
PERIOD = 5_000  # samples after which `swinging` comes back
#: Logs of the data folder -> aim [s] for their length.
REAL = {
    "ur10e_motion/run_a.csv": 1.0,
    "kr300_motion/run_a.csv": 1.0,
    "lwa4p_motion/run_a.csv": 0.5,
    "so101_motion/run_a.csv": 1.0,
}
MEMORY_MB = 1024.0
FIT_SAMPLES = 2000
_ONE = """
import resource, sys, time
from app.diagnosis.dynamic.diagnose import diagnose
from app.recordings import read_table
from app.recordings.arm import robot_for
whole = time.process_time()
table = read_table(sys.argv[1])
robot = robot_for(table, sys.argv[2] or None)
start = whole if sys.argv[3] else time.process_time()
found = diagnose(table, robot)
names = ";".join(f"{f.effect}:{f.where.get('joint')}" for f in found.findings)
taken = time.process_time() - start
most = next(line for line in open("/proc/self/status") if line.startswith("VmHWM"))
print(taken, int(most.split()[1]) / 1e3, found.verdict, names)
"""


def swinging(samples: int, rate: float = 500.0) -> tuple[np.ndarray, ...]:
    """t, q, qd, qdd of a UR10e on sums of sines."""
    rng = np.random.default_rng(1)
    t = np.arange(samples) / rate
    q, qd, qdd = np.zeros((3, samples, 6))
    for j in range(6):
        for k in range(1, 5):
            a, phase, w = rng.uniform(0.1, 0.3), rng.uniform(0, 6.28), 2 * np.pi * 0.1 * k
            q[:, j] += a * np.sin(w * t + phase)
            qd[:, j] += a * w * np.cos(w * t + phase)
            qdd[:, j] -= a * w**2 * np.sin(w * t + phase)
    return t, q - np.array([0, 1.3, -1.2, 1.0, 0.5, 0]), qd, qdd


def write(path: Path, samples: int) -> None:
    """A log with dry and viscous friction in every joint."""
    robot = load_robot("ur10e")
    t, q, qd, qdd = swinging(samples)
    level = np.array([8.0, 8.0, 5.0, 1.5, 1.5, 1.0])
    once = inverse_dynamics(robot, q[:PERIOD], qd[:PERIOD], qdd[:PERIOD])
    del qdd
    torque = np.concatenate([once] * -(-samples // len(once)))[:samples] + level * (np.sign(qd) + 1.5 * qd)
    torque += np.random.default_rng(2).normal(size=torque.shape) * 0.03 * level
    columns = {"t_s": t}
    columns |= {f"q{j + 1}_rad": q[:, j] for j in range(6)} | {
        f"tau{j + 1}_Nm": torque[:, j] for j in range(6)
    }
    with path.open("wb") as file:
        file.write(b"# kind: motion\n")
        pl.DataFrame(columns).write_csv(file, float_precision=7)


def fits() -> tuple[float, float, float]:
    """Seconds of one linear fit of the links' parameters: ours, finite differences, FIGAROH (nan if absent)."""
    robot = load_robot("ur10e")
    _, q, qd, qdd = swinging(FIT_SAMPLES, 50.0)
    torque = inverse_dynamics(robot, q, qd, qdd)

    def ours() -> np.ndarray:
        Y = torque_regressor(robot, q, qd, qdd)
        gram, right = np.zeros((60, 60)), np.zeros(60)
        for j in range(6):  # a joint feels the links beyond it only
            part = Y[:, j, 10 * j :]
            gram[10 * j :, 10 * j :] += part.T @ part
            right[10 * j :] += part.T @ torque[:, j]
        return np.linalg.solve(gram + 1e-9 * np.eye(60), right)

    def differences() -> np.ndarray:
        nominal, step = inertial_parameters(robot), 1e-6
        columns = np.empty((torque.size, 60))
        for k in range(60):
            moved = nominal.copy()
            moved[k] += step
            model = pin.Model(robot.model)
            for link in range(6):
                part = slice(10 * link, 10 * link + 10)
                model.inertias[link + 1] = pin.Inertia.FromDynamicParameters(moved[part])
            data = model.createData()
            changed = np.array(
                [pin.rnea(model, data, a, b, c).copy() for a, b, c in zip(q, qd, qdd, strict=True)]
            )
            columns[:, k] = ((changed - torque) / step).reshape(-1)
        return np.linalg.lstsq(columns, torque.reshape(-1), rcond=None)[0]

    left = np.abs(torque_regressor(robot, q, qd, qdd) @ ours() - torque)
    assert left.max() < 1e-5  # the same residual as theirs: none
    return quickest(ours, 9), quickest(differences, 3), _figaroh(robot.model, q, qd, qdd, torque)


def _figaroh(model, q, qd, qdd, torque) -> float:
    try:
        from figaroh.tools.regressor import build_regressor_basic  # pyright: ignore[reportMissingImports]
    except ImportError:
        return float("nan")

    class Arm:
        def __init__(self):
            self.model, self.data = model, model.createData()

    options = {
        "is_joint_torques": True, "is_external_wrench": False, "has_friction": False,
        "has_actuator_inertia": False, "has_joint_offset": False, "force_torque": None,
        "act_idxv": list(range(6)), "act_Jid": list(range(1, 7)),
    }  # fmt: skip

    def theirs() -> np.ndarray:
        W = build_regressor_basic(Arm(), q, qd, qdd, options)
        return np.linalg.lstsq(W, torque.T.reshape(-1), rcond=None)[0]

    return quickest(theirs, 9)


def run(lengths: tuple[int, ...] = (*LENGTHS, LONGEST)) -> list[Row]:
    """Measures and gives the rows; process time, so that other work on the machine does not count."""
    out = []
    ours, differences, figaroh = fits()
    out.append(
        Row(
            f"links' parameters, {FIT_SAMPLES} samples", ours, differences, "finite differences of pin's rnea"
        )
    )
    if np.isfinite(figaroh):
        out.append(
            Row(f"links' parameters, {FIT_SAMPLES} samples", ours, figaroh, "FIGAROH regressor + lstsq")
        )
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "log.csv"
        for samples in lengths:
            write(path, samples)
            if samples >= LONGEST:
                said = f"{samples} rows, from the file"
                out += _diagnosed(path, "ur10e", said, LONGEST_SECONDS, LONGEST_MB, reading=True)
            else:
                out += _diagnosed(path, "ur10e", f"{samples} samples", LENGTHS.get(samples))
        path.unlink()
    for name, aim in REAL.items():
        if (data_folder() / name).exists():
            out += _diagnosed(data_folder() / name, "", name, aim)
    return out


def _diagnosed(
    path: Path, robot: str, name: str, aim: float | None, memory: float = MEMORY_MB, *, reading: bool = False
) -> list[Row]:
    """Seconds and memory of a diagnosis in a process of its own; with the reading of the file where that is asked."""
    said = subprocess.run(
        [sys.executable, "-c", _ONE, str(path), robot, "1" if reading else ""],
        capture_output=True, text=True, check=True,
    ).stdout.split()  # fmt: skip
    return [
        Row(f"diagnosis, {name} ({said[2]})", float(said[0]), aim=aim),
        Row(f"its memory, {name}", float(said[1]), unit="MB", aim=memory),
    ]


if __name__ == "__main__":
    chosen = tuple(int(a) for a in sys.argv[1:]) or (*LENGTHS, LONGEST)
    for row in run(chosen):
        peer = (
            f"  {row.peer:10.3f} {row.peer_name}, ours is {row.peer / row.ours:.1f} times faster"
            if row.peer
            else ""
        )
        print(f"{row.name:<44}{row.ours:>10.3f} {row.unit}  aim {row.aim}{peer}")
    print(f"peak of this process {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB")
