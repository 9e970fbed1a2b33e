"""python -m tests.hardening.fuzz [INPUTS [SEED [PROCESSES]]]: the long run; exit code 1 where something was found."""

from __future__ import annotations

import os
import secrets
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from tests.hardening.fuzz.running import fuzz

_PORTION = 10_000  # inputs of one job


def _job(seed: int) -> tuple[int, dict[str, int], list[str]]:
    with tempfile.TemporaryDirectory() as folder:
        return seed, *fuzz(_PORTION, seed, Path(folder))


def main() -> int:
    inputs = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    first = int(sys.argv[2]) if len(sys.argv) > 2 else secrets.randbelow(2**31)
    processes = int(sys.argv[3]) if len(sys.argv) > 3 else os.cpu_count()
    done, found = 0, 0
    with ProcessPoolExecutor(processes) as pool:
        for _, counts, complaints in pool.map(_job, range(first, first + max(1, inputs // _PORTION))):
            done += sum(counts.values())
            found += len(complaints)
            for line in complaints:
                print(line, flush=True)
            print(f"{done} inputs, {found} not answered as promised", file=sys.stderr, flush=True)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
