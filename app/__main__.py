"""`teachframe COMMAND …`, the same as `python -m app COMMAND …`."""

from __future__ import annotations

import sys

from app.cli import run


def main() -> None:
    """Runs one command and leaves with its exit code."""
    sys.exit(run(sys.argv[1:]))


if __name__ == "__main__":
    main()
