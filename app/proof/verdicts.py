"""One case: what was said, held against what is true."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from app.proof.matching import SURVIVES, TELLABLE, at_place, counted, in_set, names_truth
from app.proof.units_said import si_factor
from app.proof.whole import Whole, judge_whole

Answer = Mapping[str, Any]
Said = Mapping[str, Any]

Z95 = 1.959963984540054


@dataclass(frozen=True)
class Judged:
    """A case with its score.

    Args:
        answer, said: truth and diagnosis.
        findings: those that count, see matching.py.
        seen: the truths that survive the ordinary calibration.
        place, name, listed: of each truth in `seen`: was it located, named, in the reported set.
        false: findings that are no truth of this case.
        covered: (effect, parameter, inside) of each parameter of a truth named right.
        heldout: held-out error over the true noise, where that can be said.
        empty: no finding is right here, whatever it is (nothing wrong, hidden, or outside the library).
        whole: the score of an arm that is off everywhere, see whole.py.
    """

    answer: Answer
    said: Said
    findings: Sequence[Mapping[str, Any]]
    seen: Sequence[Mapping[str, Any]]
    place: Sequence[bool]
    name: Sequence[bool]
    listed: Sequence[bool]
    false: Sequence[Mapping[str, Any]]
    covered: Sequence[tuple[str, str, bool]] = field(default=())
    heldout: float | None = None
    empty: bool = False
    whole: Whole | None = None

    @property
    def verdict(self) -> str:
        return "error" if "error" in self.said else str(self.said["verdict"])

    @property
    def right(self) -> bool:
        """Everything that could be named was, and nothing else was."""
        return self.verdict != "error" and all(self.name) and not self.false

    @property
    def tellable(self) -> bool:
        """Of an effect outside the library: it differs from every law in it by enough to be noticed."""
        return all(t["nearest"] >= TELLABLE and t["survives"] >= SURVIVES for t in self.answer["truth"])


def judge(answer: Answer, said: Said, outside: frozenset[str] = frozenset()) -> Judged:
    """Scores one case by the rules of matching.py.

    Args:
        outside: effects that no library holds.
    """
    findings = counted(said.get("findings", ()), answer)
    strange = any(t["effect"] in outside for t in answer["truth"])
    truths = [] if strange else list(answer["truth"])
    seen = [t for t in truths if t["survives"] >= SURVIVES]
    left = (said.get("leftover") or {}).get("where") or {}
    places = [f["where"] for f in findings] or ([left] if said.get("verdict") == "unexplained" else [])
    return Judged(
        answer=answer,
        said=said,
        findings=findings,
        seen=seen,
        place=[any(at_place(w, t) for w in places) for t in seen],
        name=[any(names_truth(f, t) for f in findings) for t in seen],
        listed=[in_set(findings, t) for t in seen],
        false=[f for f in findings if not any(names_truth(f, t) for t in truths)],
        covered=list(_covered(findings, truths)),
        heldout=_heldout(answer, said),
        empty=strange or not truths,
        whole=judge_whole(answer, said, outside) if "whole" in answer else None,
    )


def _covered(findings: Sequence[Mapping[str, Any]], truths: Sequence[Mapping[str, Any]]):
    """Does each stated 95% interval hold the truth? Only where the very effect was named, not an alias."""
    for truth in truths:
        for finding in findings:
            if not names_truth(finding, {**truth, "lookalikes": ()}):
                continue
            for parameter in finding.get("parameters", ()):
                true = truth["parameters"].get(parameter["name"])
                value, std = parameter.get("value"), parameter.get("std")
                if true is None or value is None or not std:
                    continue
                factor = si_factor(parameter.get("unit") or "")
                inside = abs(value * factor - true) <= Z95 * std * factor
                yield truth["effect"], parameter["name"], bool(inside)


def _heldout(answer: Answer, said: Said) -> float | None:
    """Held-out error of the final model over the noise that is really there."""
    after = said.get("after") or {}
    value, unit = after.get("heldout_rms"), after.get("unit")
    if value is None or answer.get("outlier_rows"):
        return None
    if unit == "mm" and answer.get("noise_mm"):
        return value / answer["noise_mm"]
    if unit == "Nm" and answer.get("noise_Nm"):
        noise = answer["noise_Nm"]
        return value / (sum(s * s for s in noise) / len(noise)) ** 0.5
    return None
