"""Draws sealed cases, asks the diagnosis, opens the answers and scores it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro


@dataclass
class Command:
    """Draws sealed cases, asks the diagnosis, opens the answers and scores it.

    The SHA-256 of the answers is printed before the first question. The scorecard is a page (scorecard.html),
    data (scorecard.json) and a table on stdout; the recordings and answers stay beside it.

    Example: teachframe prove static --cases 500
    """

    family: Annotated[str, tyro.conf.Positional]
    """What is proven: static (touches, tracker) or motion (joint logs)."""

    cases: int = 500
    """How many cases."""

    seed: int | None = None
    """Which cases; drawn afresh and printed unless given."""

    out: Path | None = None
    """Folder for the scorecard; proof_FAMILY_SEED unless given."""

    processes: int | None = None
    """How many side by side, each on one core; all cores unless given."""

    strata: tuple[str, ...] = ()
    """Only these kinds of cases, such as arm_tracker; all of them unless given."""

    controls: bool = True
    """Ask the negative controls too."""

    def run(self) -> int:
        import json
        import secrets
        import sys

        from app.errors import InputError
        from app.proof.page import page
        from app.proof.run import as_json, prove
        from app.proof.table import table

        if (self.seed is not None and self.seed < 0) or (self.processes is not None and self.processes < 1):
            raise InputError(
                "a seed or number of processes that cannot be", expected="--seed from 0, --processes from 1"
            )
        seed = self.seed if self.seed is not None else secrets.randbelow(2**31)
        out = self.out or Path(f"proof_{self.family}_{seed}")
        last = ""

        def say(text: str) -> None:
            nonlocal last
            if text != last:
                end = "\r" if sys.stderr.isatty() else "\n"
                if sys.stderr.isatty() or text.endswith("0%"):
                    print(text, end=end, file=sys.stderr, flush=True)
            last = text

        def tell(text: str) -> None:
            print(text, flush=True)

        proof = prove(
            self.family,
            self.cases,
            seed,
            out,
            tell=tell,
            say=say,
            processes=self.processes,
            only=self.strata,
            with_controls=self.controls,
        )
        (out / "scorecard.json").write_text(json.dumps(as_json(proof), indent=1) + "\n", encoding="utf-8")
        (out / "scorecard.html").write_text(page(proof), encoding="utf-8")
        print(table(proof))
        print(f"scorecard: {out / 'scorecard.html'}")
        return 0
