"""Rates over the arms that are off everywhere."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from app.proof.intervals import Rate
from app.proof.lines import Line
from app.proof.verdicts import Judged
from app.proof.whole import POINTS, Whole

#: Error on a second recording over the oracle's: in the median, and in nine of ten cases.
TRANSFER, TRANSFER_MOST = 1.05, 1.15
AIM = {"transfer": 0.90, "dominant": 0.90, "shares": 0.90, "untrue": 0.02, "unknown": 0.05}
COVERED = (0.92, 0.98)


def whole_lines(cases: Sequence[Judged]) -> list[Line]:
    """Lines of the scorecard; those without a case are left out."""
    arms = [(c, c.whole) for c in cases if c.whole is not None]
    referenced = [(c, w) for c, w in arms if c.answer["whole"].get("reference")]
    known = [(c, w) for c, w in arms if not w.unknown and not c.answer["whole"].get("reference")]

    def rate(pairs, value: Callable[[Whole], Any]) -> Rate:
        values = [v for _, w in pairs if (v := value(w)) is not None]
        return Rate(sum(bool(v) for v in values), len(values))

    shares = [abs(was - said) <= POINTS for _, w in known for _, was, said in w.shares]
    covered = [inside for _, w in arms if not w.unknown for _, _, inside in w.covered]
    untrue = [(c.verdict == "named" and bool(w.untrue)) for c, w in known]
    loose = [bool(w.untrue) for _, w in known]
    strange = [(c.verdict == "named" and bool(w.untrue)) for c, w in arms if w.unknown]
    added = [bool(w.untrue) for _, w in referenced]
    dominant = AIM["dominant"]
    lines = [
        Line(
            "arm_transfer",
            f"real arm: carried to a second run, within {TRANSFER_MOST:.0%} of the oracle",
            rate(known, lambda w: None if w.transfer is None else w.transfer <= TRANSFER_MOST),
            AIM["transfer"],
        ),
        Line(
            "arm_over_best",
            f"… within {TRANSFER_MOST:.0%} of the best that can be had",
            rate(known, lambda w: None if w.over_best is None else w.over_best <= TRANSFER_MOST),
        ),
        Line(
            "arm_transfer_unknown",
            "… of an oracle that knows a law no library holds",
            rate(
                [(c, w) for c, w in arms if w.unknown],
                lambda w: None if w.transfer is None else w.transfer <= TRANSFER_MOST,
            ),
        ),
        Line(
            "arm_self",
            "real arm: saved model does what `after` says",
            rate(arms, lambda w: w.consistent),
            1.0,
        ),
        Line("arm_place", "real arm: dominant effect, place right", rate(known, lambda w: w.place), dominant),
        Line("arm_name", "real arm: dominant effect, name right", rate(known, lambda w: w.name), dominant),
        Line("arm_set", "real arm: dominant effect in the reported set", rate(known, lambda w: w.listed)),
        Line(
            "arm_value",
            "real arm: dominant value within 25% and 3 sd",
            rate(known, lambda w: w.value),
            dominant,
        ),
        Line(
            "arm_shares",
            "real arm: shares of the budget within 10 points",
            Rate(sum(shares), len(shares)),
            AIM["shares"],
        ),
        Line(
            "arm_untrue",
            "real arm: untrue finding under `named`",
            Rate(sum(untrue), len(untrue)),
            AIM["untrue"],
            True,
        ),
        Line("arm_untrue_any", "real arm: untrue finding, any verdict", Rate(sum(loose), len(loose))),
        Line(
            "arm_unknown",
            "real arm: unknown effect, falsely named",
            Rate(sum(strange), len(strange)),
            AIM["unknown"],
            True,
        ),
        Line(
            "arm_load",
            "against a reference: load's mass within 3%",
            rate(referenced, lambda w: w.load),
            dominant,
        ),
        Line(
            "arm_reference",
            "against a reference: anything named that did not change",
            Rate(sum(added), len(added)),
            AIM["untrue"],
            True,
        ),
        Line(
            "arm_cover",
            "real arm: stated 95% intervals that hold",
            Rate(sum(covered), len(covered)),
            COVERED[0],
            also_at_most=COVERED[1],
        ),
    ]
    return [line for line in lines if line.rate.cases]


def transfer_summary(cases: Sequence[Judged], over: str = "transfer") -> dict[str, Any]:
    """Median and quartiles of the error on a second run over an observer's; {} without a case of laws of the library.

    Args:
        over: "transfer" (the oracle) or "over_best" (the informed observer).
    """
    ratios = [
        v for c in cases if c.whole and not c.whole.unknown and (v := getattr(c.whole, over)) is not None
    ]
    if not ratios:
        return {}
    low, middle, high, most = (
        float(v) for v in np.quantile(ratios, [0.25, 0.5, 0.75, 0.9], method="nearest")
    )
    return {
        "cases": len(ratios),
        "lower_quartile": low,
        "median": middle,
        "upper_quartile": high,
        "nine_of_ten": most,
        "aim": TRANSFER,
        "met": middle <= TRANSFER,
    }
