"""`teachframe COMMAND …`, the same as `python -m app COMMAND …`."""

from __future__ import annotations

import os
import sys
import warnings

# Before numpy is loaded, here and in every worker: the matrices are small, and threads that wait for each other
# make a search several times slower.
for _library in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_library, "1")

from app.cli import run  # noqa: E402


def main() -> None:
    """Runs one command and leaves with its exit code."""
    if not os.environ.get("TEACHFRAME_DEBUG"):
        warnings.simplefilter("ignore")  # those of libraries are for developers; a person reads one line
    sys.exit(run(sys.argv[1:]))


if __name__ == "__main__":
    main()
