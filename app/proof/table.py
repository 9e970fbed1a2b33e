"""The scorecard as a short table for a terminal."""

from __future__ import annotations

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
            f"{line.title:<68}{line.rate.cases:>6}{value:>8.1%}   {span:<16}  {aim_text(line):<12}{mark}".rstrip()
        )
    held = heldout_summary([v for _, v in proof.score.heldout])
    if held:
        rows.append(
            f"held-out error over the true noise: median {held['median']:.3f}, "
            f"middle half {held['lower_quartile']:.3f} to {held['upper_quartile']:.3f} ({held['cases']} cases); "
            f"aim at most {held['aim']:.2f}: {'met' if held['met'] else 'MISSED'}"
        )
    for kind, (rate, _) in proof.controls.items():
        mark = "empty" if not rate.hits else "NOT EMPTY"
        rows.append(f"control {kind:<12} {rate.hits} of {rate.cases} named something  {mark}")
    return "\n".join(rows)


def aim_text(line) -> str:
    """The aim of a line, as a reader says it."""
    if line.aim is None:
        return ""
    if line.also_at_most is not None:
        return f"{line.aim:.0%} to {line.also_at_most:.0%}"
    return f"{'at most' if line.at_most else 'at least'} {line.aim:.0%}"
