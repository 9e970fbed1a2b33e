"""The terminal's version of a diagnosis: what an operator needs on top, what an engineer needs below."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from pathlib import Path

from app.diagnosis.report.wording import (
    effect_title,
    fall,
    joint_values,
    measure,
    noise_source,
    place,
    probability,
    quantity,
    verdict_sentence,
)
from app.diagnosis.result import Diagnosis, Finding, Judged

WIDTH = 100
_LABEL = 17


def as_text(diagnosis: Diagnosis, *, prismatic: Sequence[bool] = (), seconds: bool = True) -> str:
    """The whole diagnosis as lines of at most 100 characters.

    Args:
        prismatic: which joints slide, so that proposed poses carry the right unit.
        seconds: False leaves the running time out.
    """
    d = diagnosis
    time = f" · {d.seconds:.2f} s" if seconds else ""
    lines = [
        f"{d.file} · {d.kind} recording · {d.samples} samples · robot {d.robot}{time}",
        "",
        *_wrapped(f"{d.verdict.upper()}: {verdict_sentence(d)}"),
        "",
        *_quality(d),
    ]
    if d.judged is not None:
        lines += ["", *_judged(d.judged)]
    for number, finding in enumerate(d.findings, 1):
        lines += ["", *_finding(number, finding, d.after.unit)]
    lines += ["", *_rest(d, prismatic)]
    return "\n".join(lines).rstrip() + "\n"


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


def _finding(number: int, f: Finding, unit: str) -> list[str]:
    unit = f.heldout_unit or unit
    lines = _wrapped(f"{number}. {effect_title(f.effect)} · {place(f.where)}", indent=3)
    lines += _wrapped(f"   {f.sentence}", indent=3)
    for parameter in f.parameters:
        lines += _item(parameter.name, quantity(parameter))
    lines += _item("certainty", f"{probability(f.p_value)} over the whole search")
    lines += _item("visible", f"{f.visible:.0%} of it (the rest can hide in what else was fitted)")
    lines += _item(
        "held out",
        f"{measure(f.heldout_rms_without, unit)} without it, {measure(f.heldout_rms_with, unit)} with it",
    )
    if f.equation:
        lines += _item("law", f.equation)
    for i, a in enumerate(f.alternatives):
        label = "not ruled out" if i == 0 else ""
        lines += _item(label, f"{effect_title(a.effect)} · {place(a.where)} (ΔBIC {a.delta_bic:+.1f})")
    return lines


def _rest(d: Diagnosis, prismatic: Sequence[bool]) -> list[str]:
    lines = []
    if d.leftover.p_value is not None:
        left = probability(d.leftover.p_value)
        if d.verdict in ("clean", "named"):
            lines += _item("left over", f"nothing beyond noise ({left})", 0)
        else:
            lines += _item("left over", f"structure at {place(d.leftover.where)} ({left})", 0)
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
