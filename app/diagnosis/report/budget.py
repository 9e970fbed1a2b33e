"""Where the error comes from: the families of a diagnosis as amounts that add up to the error before.

The amount of a family is the fall of the held-out error when it is added to those before it in the order of the
budget. What remains after the last is noise, or not known. Screen, page, terminal and benchmarks take these numbers
and these words from here.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from app.diagnosis.report.wording import digits, measure, probability
from app.diagnosis.result import MOTION_FAMILIES, UNNAMED, Diagnosis, Finding
from app.diagnosis.wording import FALLBACK, WORDS

#: A law that explains less of the mean square before than this is not listed by name but folded into its family.
SMALL_LAW = 0.02
#: A family whose amount is below this share of the error before is not named in the sentence.
SMALL_AMOUNT = 0.01
#: A remainder whose p lies above this is not said to be no noise.
CHANCE = 0.05
#: Shares below this are said to be below it.
LEAST_SHARE = 0.01
#: A family that lowers the error by less than this share of it adds nothing to those before it.
NOTHING = 1e-3


@dataclass(frozen=True)
class Step:
    """One family of the budget.

    Args:
        family: its key.
        amount: by how much it lowers the held-out error, in the budget's unit; never negative.
        left: held-out error with it and all before it.
        share: (0..1) of the mean square before, above noise, that is lost without it.
        members: indices of its findings that are worth a name, in their order.
        small: indices of those that are folded.
    """

    family: str
    amount: float
    left: float
    share: float
    members: tuple[int, ...] = ()
    small: tuple[int, ...] = ()


@dataclass(frozen=True)
class Budget:
    """The whole.

    Args:
        total: held-out error before.
        unit: mm or Nm.
        steps: families in their order; `total` less their amounts is `rest`.
        rest: held-out error that no family takes away.
        others: indices of findings that belong to no family.
        known: True where the families were measured; else there is nothing to divide up.
    """

    total: float
    unit: str
    steps: tuple[Step, ...]
    rest: float
    others: tuple[int, ...] = ()

    @property
    def known(self) -> bool:
        return bool(self.steps) and math.isfinite(self.total) and self.total > 0


def budget(diagnosis: Diagnosis) -> Budget:
    """The families of a diagnosis as amounts; an error that rises from one family to the next counts as none."""
    d = diagnosis
    left, steps = d.before.heldout_rms, []
    for family in d.families:
        after = min(left, family.heldout_rms_after) if math.isfinite(family.heldout_rms_after) else left
        # A family that is one law has that law's share, whatever others could take over of it when it is taken out.
        alone = len(family.members) == 1 and family.share >= SMALL_LAW
        small = () if alone else tuple(k for k in family.members if _small(d.findings[k], d))
        steps.append(
            Step(
                family.family,
                left - after,
                after,
                family.share,
                tuple(k for k in family.members if k not in small),
                small,
            )
        )
        left = after
    belonging = {k for family in d.families for k in family.members}
    others = tuple(k for k in range(len(d.findings)) if k not in belonging)
    return Budget(d.before.heldout_rms, d.before.unit, tuple(steps), left, others)


def shown(of: Budget) -> tuple[Step, ...]:
    """Families worth a line: those that take something away, would be missed or hold findings."""
    return tuple(s for s in of.steps if s.amount > 0 or s.share >= LEAST_SHARE / 2 or s.members or s.small)


def shared(step: Step, of: Budget) -> bool:
    """True for a family that takes nothing away although it would be missed: those before it had explained its part.

    Its amount is what it adds to them, its share what comes back where the others stay as they are.
    """
    return step.amount < NOTHING * of.total and step.share >= LEAST_SHARE / 2


def takes_away(step: Step, of: Budget) -> str:
    """A family's amount in words; a dash where it is `shared`, since "0 mm" would say that it is not needed."""
    return "–" if shared(step, of) else measure(step.amount, of.unit)


def shared_note(listed: Sequence[Step], of: Budget, language: str = FALLBACK) -> str:
    """What the dash means; "" where none of those that are listed has one."""
    return WORDS.text("budget.shared", language) if any(shared(s, of) for s in listed) else ""


def law_share(finding: Finding, diagnosis: Diagnosis) -> float:
    """Share (0..1) of the mean square before that comes back when this one finding is taken out; NaN if unknown.

    As of families: the rest as it is. Where that was not measured, the rest refitted.
    """
    if math.isfinite(finding.share):
        return max(0.0, min(1.0, finding.share))
    before = diagnosis.before.heldout_rms
    without, with_it = finding.heldout_rms_without, finding.heldout_rms_with
    if finding.heldout_unit or not (math.isfinite(before) and before > 0):
        return math.nan
    return max(0.0, min(1.0, (without**2 - with_it**2) / before**2))


def _small(finding: Finding, diagnosis: Diagnosis) -> bool:
    return law_share(finding, diagnosis) < SMALL_LAW


def in_order(parts: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """What families add to a log's torques, in the order of the budget; unknown ones last."""
    rank = {family: k for k, family in enumerate(MOTION_FAMILIES)}
    return {f: np.asarray(parts[f]) for f in sorted(parts, key=lambda f: rank.get(f, len(rank)))}


def family_name(key: str, language: str = FALLBACK) -> str:
    """`zeros` -> "joint zeros"."""
    name = f"family.{key}"
    return WORDS.text(name, language) if WORDS.has(name) else key.replace("_", " ")


def budget_sentence(diagnosis: Diagnosis, language: str = FALLBACK) -> str:
    """ "Of 5.10 mm, 4.8 are joint zeros, 0.20 geometry; 0.10 has no name; 0.06 is noise"; "" where nothing is known."""
    of = budget(diagnosis)
    if not of.known:
        return ""
    named = [s for s in of.steps if s.family != UNNAMED and s.amount >= SMALL_AMOUNT * of.total]
    parts = [
        WORDS.text(
            "budget.first" if k == 0 else "budget.then",
            language,
            amount=digits(step.amount, 2),
            family=family_name(step.family, language),
        )
        for k, step in enumerate(named)
    ]
    clauses = [WORDS.text("budget.between", language).join(parts)] if parts else []
    unnamed = sum(s.amount for s in of.steps if s.family == UNNAMED)
    if unnamed >= SMALL_AMOUNT * of.total:
        clauses.append(WORDS.text("budget.unnamed", language, amount=digits(unnamed, 2)))
    clauses.append(_rest(of, diagnosis, language))
    said = WORDS.text("budget.clauses", language).join(clauses)
    return WORDS.text("budget.sentence", language, total=measure(of.total, of.unit), parts=said)


def _rest(of: Budget, d: Diagnosis, language: str) -> str:
    """What no family takes away: noise, or noise and more."""
    amount = digits(of.rest, 2)
    known = d.noise.unit == of.unit and d.noise.source != "residual" and math.isfinite(d.noise.value)
    if d.verdict in ("clean", "named"):
        return WORDS.text("budget.noise" if known else "budget.as_noise", language, amount=amount)
    if not known:
        return WORDS.text("budget.left", language, amount=amount)
    return WORDS.text("budget.left_noise", language, amount=amount, noise=digits(d.noise.value, 2))


def unexplained_sentence(diagnosis: Diagnosis, language: str = FALLBACK) -> str:
    """How much no name explains, said beside the names; the verdict says where. "" where nothing is left over."""
    d = diagnosis
    if d.verdict in ("clean", "named"):
        return ""
    p = probability(d.leftover.p_value, language)
    if not (math.isfinite(d.leftover.share) and d.leftover.share > 0):
        if not d.leftover.p_value <= CHANCE:
            return ""  # the verdict says that something is left; how much, nobody measured
        return WORDS.text("budget.unexplained", language, p=p)
    return WORDS.text("budget.unexplained_share", language, share=percent(d.leftover.share), p=p)


def folded_sentence(count: int, language: str = FALLBACK) -> str:
    """How many laws of a family are too small to be named."""
    return WORDS.text("page.found.folded", language, count=count, share=percent(SMALL_LAW))


def percent(share: float) -> str:
    """A share as a whole percentage; what is there but rounds to nothing is said to be below one."""
    if not math.isfinite(share):
        return "–"
    return f"<{LEAST_SHARE:.0%}" if 0.0 < share < LEAST_SHARE / 2 else f"{share:.0%}"
