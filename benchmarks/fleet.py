"""Many simulated recordings: rows lost or doubled where workers and the scheduler are killed; what a cluster costs.

Run: python -m benchmarks fleet; with 10,000 recordings: python -m benchmarks.fleet 10000
"""

from __future__ import annotations

import multiprocessing
import os
import re
import resource
import subprocess
import sys
import tempfile
import threading
import time
from datetime import date, timedelta
from pathlib import Path

import polars as pl

from benchmarks._cluster import Cluster
from benchmarks.rows import Row

COUNT, COMPARED = 200, 300  # recordings of a short run; at most so many are done twice to compare the cost
ARMS, SAMPLES = 50, 20
_FIRST = date(2025, 1, 6)
_SAME = ["file", "verdict", "before", "after", "key", "error"]  # columns that do not depend on who did it


def run(count: int = COUNT) -> list[Row]:
    """Rows lost, doubled, different; processor time of a cluster of two over that of two processes."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        recordings = folder / "recordings"
        made = make(recordings, count)
        compared = folder / "compared.txt"
        compared.write_text("\n".join(map(str, made[:COMPARED])) + "\n", encoding="utf-8")
        plain = _used(lambda: fleet(compared, folder / "plain.parquet", "--processes", "2"))
        cluster = Cluster(2, folder)
        try:
            begun = cluster.processor()
            driver = _used(lambda: fleet(compared, folder / "dask.parquet", "--scheduler", cluster.address))
            dask = cluster.processor() - begun + driver
        finally:
            cluster.stop()
        cluster = Cluster(2, folder)
        try:
            seconds = _killed(cluster, recordings, folder / "killed.parquet", count)
        finally:
            cluster.stop()
        first, second, third = (_rows(folder / f"{which}.parquet") for which in ("plain", "dask", "killed"))
        files = third["file"].to_list()
        other = 0 if first.equals(second) else 1
        some = third.filter(pl.col("file").is_in(first["file"].to_list()))
    return [
        Row(f"{count} recordings, a worker and the scheduler killed", seconds),
        Row("rows lost", len({str(path) for path in made} - set(files)), unit="", aim=0.5),
        Row("rows doubled", len(files) - len(set(files)), unit="", aim=0.5),
        Row(
            "rows of a disturbed run that differ",
            (some != first).sum().sum_horizontal().item(),
            unit="",
            aim=0.5,
        ),
        Row("results of a cluster and of processes differ", other, unit="", aim=0.5),
        Row(f"processor time of {len(first)} recordings, cluster over processes", dask, plain, "2 processes"),
    ]


def make(folder: Path, count: int) -> list[Path]:
    """Recordings of many arms over months; all arms share one effect, every tenth arm's grows."""
    folder.mkdir()
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        return sorted(pool.starmap(_one, [(folder, number) for number in range(count)], chunksize=50))


def _one(folder: Path, number: int) -> Path:
    from app.proof.generator.simulate import simulate_static
    from app.proof.generator.static.plan import Plan

    arm, month = number % ARMS, number // ARMS
    size = 3e-5 * (1 + 0.02 * arm / ARMS + (0.05 * month if arm % 10 == 0 else 0.0))
    path = folder / f"SN-{arm:03d}" / f"{_FIRST + timedelta(days=7 * month):%Y-%m-%d}.csv"
    path.parent.mkdir(exist_ok=True)
    effect = f"joint_compliance:joint=2,compliance={size}"
    simulate_static("ur5", Plan(kind="tracker", samples=SAMPLES, noise=1.5e-4), [effect], number, path)
    return path


def fleet(where: Path, out: Path, *options: str) -> None:
    """`teachframe fleet` as a person starts it."""
    command = [sys.executable, "-m", "app", "fleet", str(where), "--out", str(out), *options]
    log = out.with_suffix(".log")
    with log.open("wb") as said:
        done = subprocess.run(command, stdout=said, stderr=said, check=False)
    if done.returncode:
        raise RuntimeError(log.read_text(encoding="utf-8")[-400:])


def _killed(cluster: Cluster, where: Path, out: Path, count: int) -> float:
    """A run in which a worker is killed after a third of the rows and the scheduler after two thirds."""
    begun = time.perf_counter()
    running = threading.Thread(target=fleet, args=(where, out, "--scheduler", cluster.address))
    running.start()
    for share, name in ((1 / 3, "worker 0"), (2 / 3, "scheduler")):
        while running.is_alive() and _kept(out) < share * count:
            time.sleep(0.2)
        cluster.kill(name)
    running.join()
    return time.perf_counter() - begun


def _kept(out: Path) -> int:
    """Rows so far, as the run says on its way."""
    log = out.with_suffix(".log")
    said = re.findall(r"^(\d+) of \d+", log.read_text(encoding="utf-8") if log.exists() else "", re.MULTILINE)
    return int(said[-1]) if said else 0


def _rows(results: Path) -> pl.DataFrame:
    return pl.read_parquet(results, columns=_SAME).sort("file")


def _used(work) -> float:
    """Processor time of the processes that a call starts and waits for."""

    def now() -> float:
        spent = resource.getrusage(resource.RUSAGE_CHILDREN)
        return spent.ru_utime + spent.ru_stime

    begun = now()
    work()
    return now() - begun


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    for row in run(int(sys.argv[1]) if len(sys.argv) > 1 else COUNT):
        print(
            f"{row.name}: {row.ours:.6g}"
            + ("" if row.peer is None else f" / {row.peer:.6g} = {row.ratio:.3f}")
        )
