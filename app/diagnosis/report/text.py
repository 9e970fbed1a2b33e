"""The terminal's version of a diagnosis: what an operator needs on top, what an engineer needs below."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from pathlib import Path

from app.diagnosis.quantity import quantity
from app.diagnosis.report.budget import (
    SMALL_LAW,
    Budget,
    Step,
    budget,
    budget_sentence,
    family_name,
    law_share,
    percent,
    shared_note,
    shown,
    takes_away,
    unexplained_sentence,
)
from app.diagnosis.report.wording import (
    effect_title,
    fall,
    joint_values,
    measure,
    noise_source,
    parameter_name,
    place,
    probability,
    rivals,
    verdict_sentence,
)
from app.diagnosis.result import Diagnosis, Judged
from app.figures import unsigned

WIDTH = 100
_LABEL = 17
_BAR = 30  # letters of the longest bar


def as_text(
    diagnosis: Diagnosis, *, prismatic: Sequence[bool] = (), seconds: bool = True, flange: str = ""
) -> str:
    """The whole diagnosis as lines of at most 100 characters: verdict, error budget, laws by family.

    Args:
        prismatic: which joints slide, so that proposed poses carry the right unit.
        seconds: False leaves the running time out.
        flange: the link that was taken as the flange, where it is to be named.
    """
    d = diagnosis
    of = budget(d)
    time = f" · {d.seconds:.2f} s" if seconds else ""
    at = f", flange {flange}" if flange else ""
    lines = [
        f"{d.file} · {d.kind} recording · {d.samples} samples · robot {d.robot}{at}{time}",
        "",
        *_wrapped(f"{d.verdict.upper()}: {verdict_sentence(d)}"),
        *_wrapped(budget_sentence(d)),
        *_wrapped(unexplained_sentence(d)),
        "",
        *_quality(d),
        *_families(of),
    ]
    if d.judged is not None:
        lines += ["", *_judged(d.judged)]
    laws: set[str] = set()
    for step in of.steps:
        if step.members or step.small:
            lines += ["", _family(step, of)]
            lines += [line for k in step.members for line in _finding(d, k, laws)]
            if step.small:
                lines += _small(d, step.small)
    for k in of.others:
        lines += ["", *_finding(d, k, laws)]
    lines += ["", *_rest(d, prismatic)]
    return unsigned("\n".join(lines).rstrip() + "\n")


def _quality(d: Diagnosis) -> list[str]:
    unit = d.before.unit
    row = "{:<17}{:>12}{:>12}   {}".format
    return [
        row("error (rms)", "before", "after", "").rstrip(),
        row(
            "  rows fitted",
            measure(d.before.fit_rms, unit),
            measure(d.after.fit_rms, unit),
            fall(d.before.fit_rms, d.after.fit_rms),
        ).rstrip(),
        row(
            "  rows held out",
            measure(d.before.heldout_rms, unit),
            measure(d.after.heldout_rms, unit),
            fall(d.before.heldout_rms, d.after.heldout_rms),
        ).rstrip(),
        row("  noise", "", measure(d.noise.value, d.noise.unit), noise_source(d.noise.source)),
    ]


def _families(of: Budget) -> list[str]:
    """The budget as a table with bars: each family's amount, what is left with it, its share."""
    if not of.known:
        return []
    row = "  {:<15}{:>12}{:>12}   {:>4}  {}".format
    lines = [
        "",
        "  {:<15}{:>12}{:>12}   {}".format("error budget", "takes away", "leaves", "comes back without it"),
    ]
    for s in shown(of):
        bar = "█" * round(_BAR * s.amount / of.total)
        lines.append(
            row(
                family_name(s.family),
                takes_away(s, of),
                measure(s.left, of.unit),
                percent(s.share),
                bar,
            )
        )
    return [line.rstrip() for line in lines] + _wrapped(f"  {shared_note(shown(of), of)}", indent=2)


def _family(step: Step, of: Budget) -> str:
    name = family_name(step.family)
    return f"{name[:1].upper()}{name[1:]} · {takes_away(step, of)} · {percent(step.share)}"


def _small(d: Diagnosis, small: Sequence[int]) -> list[str]:
    """Laws that are folded: how many, and where."""
    named = (f"{effect_title(d.findings[k].effect)} ({place(d.findings[k].where)})" for k in small)
    return _wrapped(
        f"   {len(small)} more below {SMALL_LAW:.0%} of the error each: {'; '.join(named)}", indent=3
    )


def _judged(judged: Judged) -> list[str]:
    """What a model learnt elsewhere makes of this recording."""
    first = next(iter(judged.steps.values()))
    fitted = "" if first.unit == "Nm" else ", base and tool fitted anew"
    learnt = Path(judged.source).name if judged.source else "elsewhere"
    lines = _wrapped(
        f"the given model on this recording (learnt on {learnt}{fitted}), rows held out:", indent=2
    )
    for what, quality in judged.steps.items():
        smaller = "" if quality is first else fall(first.heldout_rms, quality.heldout_rms)
        lines.append(f"  {what:<29}{measure(quality.heldout_rms, quality.unit):>10}   {smaller}".rstrip())
    return lines


def _finding(d: Diagnosis, k: int, laws: set[str]) -> list[str]:
    """One law; its equation the first time that it stands there."""
    f = d.findings[k]
    unit, share = f.heldout_unit or d.after.unit, law_share(f, d)
    head = f"{k + 1}. {effect_title(f.effect)} · {place(f.where)}"
    lines = _wrapped(f"{head} · {percent(share)}" if math.isfinite(share) else head, indent=3)
    lines += _wrapped(f"   {f.sentence}", indent=3)
    for parameter in f.parameters:
        lines += _item(parameter_name(parameter.name), quantity(parameter))
    without, with_it = (measure(v, unit) for v in (f.heldout_rms_without, f.heldout_rms_with))
    lines += _item("held out", f"{without} without it, {with_it} with it")
    lines += _item(
        "certainty", f"{probability(f.p_value)} over the whole search; {f.visible:.0%} of it is visible here"
    )
    if f.equation and f.equation not in laws:
        laws.add(f.equation)
        lines += _item("law", f.equation)
    if f.alternatives:
        lines += _item("not ruled out", rivals(f))
    return lines


def _rest(d: Diagnosis, prismatic: Sequence[bool]) -> list[str]:
    lines = []
    if d.leftover.p_value is not None and d.verdict in ("clean", "named"):
        lines += _item("left over", f"nothing beyond noise ({probability(d.leftover.p_value)})", 0)
    if d.outliers:
        lines += _item("set aside", f"{_rows(d.outliers)}: far off and not used", 0)
    for i, q in enumerate(d.next_poses):
        lines += _item("next poses" if i == 0 else "", joint_values(q, prismatic), 0)
    for i, note in enumerate(d.notes):
        lines += _item("notes" if i == 0 else "", note, 0)
    return lines


def _rows(rows: Sequence[int]) -> str:
    shown = ", ".join(str(r) for r in rows[:20])
    more = f" and {len(rows) - 20} more" if len(rows) > 20 else ""
    return f"line{'' if len(rows) == 1 else 's'} {shown}{more} of the file"


def _item(label: str, text: str, indent: int = 3) -> list[str]:
    head = " " * indent + f"{label:<{_LABEL - indent}}"
    return textwrap.wrap(
        text,
        WIDTH,
        initial_indent=head if head.endswith(" ") else head + " ",
        subsequent_indent=" " * _LABEL,
        break_on_hyphens=False,
    )


def _wrapped(text: str, indent: int = 0) -> list[str]:
    return textwrap.wrap(
        text.strip(),
        WIDTH,
        initial_indent=" " * (len(text) - len(text.lstrip())),
        subsequent_indent=" " * indent,
        break_on_hyphens=False,
    )
