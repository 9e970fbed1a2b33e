"""`teachframe COMMAND …`, the same as `python -m app COMMAND …`."""

from __future__ import annotations

import os
import sys
import warnings

from app.cli import run


def main() -> None:
    """Runs one command and leaves with its exit code."""
    if not os.environ.get("TEACHFRAME_DEBUG"):
        warnings.simplefilter("ignore")  # those of libraries are for developers; a person reads one line
    sys.exit(run(sys.argv[1:]))


if __name__ == "__main__":
    main()
