"""The scorecard as a short table for a terminal."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from app.proof.run import Proof
from app.proof.scoring import heldout_summary


def table(proof: Proof) -> str:
    """Lines of text: every rate with its interval beside its aim."""
    rows = [f"{'':<68}{'cases':>6}{'rate':>8}   {'95% interval':<16}{'aim':<14}"]
    for line in proof.score.lines:
        low, high = line.rate.interval
        value = line.rate.value or 0.0
        mark = {True: "met", False: "MISSED", None: ""}[line.met]
        span = f"{low:.1%} to {high:.1%}"
        rows.append(
            f"{line.title:<68}{line.rate.cases:>6}{value:>8.1%}   {span:<16}  {aim_text(line):<14}{mark}".rstrip()
        )
    held = heldout_summary([v for _, v in proof.score.heldout])
    if held:
        rows.append(
            f"held-out error over the true noise: median {held['median']:.3f}, "
            f"middle half {held['lower_quartile']:.3f} to {held['upper_quartile']:.3f} ({held['cases']} cases); "
            f"aim at most {held['aim']:.2f}: {'met' if held['met'] else 'MISSED'}"
        )
    for over, told in proof.score.transfer.items():
        rows.append(transfer_text(over, told))
    for kind, (rate, _) in proof.controls.items():
        mark = "empty" if not rate.hits else "NOT EMPTY"
        rows.append(f"control {kind:<12} {rate.hits} of {rate.cases} named something  {mark}")
    return "\n".join(rows)


OVER = {"transfer": "of the oracle", "over_best": "of the best that can be had"}


def transfer_text(over: str, told: Mapping[str, Any]) -> str:
    """How models did on a second run, in one line."""
    aim = (
        f"; aim at most {told['aim']:.2f}: {'met' if told['met'] else 'MISSED'}" if over == "transfer" else ""
    )
    return (
        f"error on a second run over that {OVER[over]}: median {told['median']:.3f}, middle half "
        f"{told['lower_quartile']:.3f} to {told['upper_quartile']:.3f}, nine of ten below "
        f"{told['nine_of_ten']:.3f} ({told['cases']} cases){aim}"
    )


def aim_text(line) -> str:
    """The aim of a line, as a reader says it."""
    if line.aim is None:
        return ""
    if line.also_at_most is not None:
        return f"{line.aim:.0%} to {line.also_at_most:.0%}"
    return f"{'at most' if line.at_most else 'at least'} {line.aim:.0%}"
