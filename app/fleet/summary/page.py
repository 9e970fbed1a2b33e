"""The summary as a page (autoescaped, nothing from outside) and as text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Any

from app import __version__
from app.diagnosis.quantity import quantity
from app.diagnosis.report.style import CSS
from app.diagnosis.report.wording import effect_title, parameter_name, place
from app.diagnosis.result import Parameter
from app.fleet.summary.drift import Drift, drifts
from app.fleet.summary.news import News, news
from app.fleet.summary.seen import Seen, Value, What, seen
from app.fleet.summary.shared import Shared, shared
from app.fleet.wording import WORDS
from app.fleet.work import Row
from app.templating import templates

_NAMED = 12  # arms, errors and lines that are written out
_WIDE, _HIGH = 150, 34  # pixels of a course


@dataclass(frozen=True)
class Summary:
    """What many recordings say together.

    Args:
        files, broken: recordings, and those without a diagnosis.
        arms: how many.
        verdicts: verdict -> recordings.
        errors: (reason, line) of broken ones, at most a page full.
        series: values that were long enough to be followed.
        run: number of the last run.
    """

    files: int
    broken: int
    arms: int
    verdicts: Counter[str]
    errors: tuple[tuple[str, str], ...]
    shared: tuple[Shared, ...]
    drifts: tuple[Drift, ...]
    series: int
    news: News | None
    run: int
    reasons: Counter[str] = field(default_factory=Counter)


def summarised(rows: Iterable[Row], run: int = 0) -> Summary:
    """The summary of a results file's rows.

    Args:
        rows: all of them.
        run: number of the last run, which may have read nothing; 0 takes that of the newest row.
    """
    found: list[Seen] = []
    errors: list[tuple[str, str]] = []
    reasons: Counter[str] = Counter()
    arms: set[str] = set()
    files = 0
    for row in rows:
        files, run = files + 1, max(run, row.run)
        arms |= {row.arm} - {""}
        if row.error:
            reasons[row.reason] += 1
            if len(errors) < _NAMED:
                errors.append((row.reason, row.error))
            continue
        found.append(seen(row))
    changing, series = drifts(found)
    return Summary(
        files=files,
        broken=sum(reasons.values()),
        arms=len(arms),
        verdicts=Counter(one.verdict for one in found),
        errors=tuple(errors),
        shared=tuple(shared(found)),
        drifts=tuple(changing),
        series=series,
        news=news(found, run),
        run=run,
        reasons=reasons,
    )


def as_text(summary: Summary, language: str = "en") -> str:
    """For a terminal: the same as the page, a line each."""
    say = _Said(summary, language)
    lines = [say.counted, "  ".join(f"{name} {count}" for name, count in say.verdicts), ""]
    lines += [say.t("shared"), *(f"  {' · '.join(filter(None, row))}" for row in say.shared), ""]
    lines += [say.t("drift"), f"  {say.drift_line}", *(f"  {' · '.join(row)}" for row, _ in say.drifts), ""]
    lines += [say.t("news"), *(f"  {line}" for line in say.news), ""]
    lines += [say.t("broken"), *(f"  {line}" for line in say.broken)]
    return "\n".join(lines) + "\n"


def as_page(summary: Summary, language: str = "en") -> str:
    """One HTML file."""
    say = _Said(summary, language)
    today = datetime.now(UTC).date().isoformat()
    return (
        templates(__file__).get_template("fleet.html").render(say=say, css=CSS, language=language, date=today)
    )


class _Said:
    """All sentences and cells of a summary in one language."""

    def __init__(self, summary: Summary, language: str):
        self._summary, self._language = summary, language
        self.made = self.t("made", version=__version__, run=summary.run)
        self.counted = self.t("counted", files=summary.files, arms=summary.arms, broken=summary.broken)
        self.verdicts = [
            (WORDS.text(f"verdict.{name}", language), summary.verdicts[name])
            for name in ("clean", "named", "partly", "unexplained")
            if summary.verdicts[name]
        ]
        self.shared = [self._shared(one) for one in summary.shared] or [(self.t("shared_none"),)]
        self.drifts = [(self._drift(one), _course(one)) for one in summary.drifts]
        self.drift_line = self.t(
            "drift_few" if not summary.series else "drift_some" if summary.drifts else "drift_none",
            series=summary.series,
            drifts=len(summary.drifts),
        )
        self.news = self._news(summary.news)
        self.broken = [
            *(
                f"{WORDS.text(f'reason.{why}', language)}: {count}"
                for why, count in summary.reasons.most_common()
            ),
            *(line for _, line in summary.errors),
        ] or [self.t("broken_none")]

    def t(self, key: str, **fields: Any) -> str:
        return WORDS.text(f"fleet.{key}", self._language, **fields)

    def _what(self, what: What) -> tuple[str, str]:
        return effect_title(what.effect, self._language), place(what.place, self._language)

    def _value(self, value: Value) -> str:
        said = quantity(Parameter(value.name, value.value, value.std, value.unit), self._language)
        return f"{parameter_name(value.name, self._language)} {said}"

    def _shared(self, one: Shared) -> tuple[str, ...]:
        named = list(one.arms[:_NAMED])
        if len(one.arms) > _NAMED:
            named.append(self.t("more", count=len(one.arms) - _NAMED))
        typical = "" if one.typical is None else self._value(one.typical)
        between = WORDS.text("list.between", self._language)
        return (*self._what(one.what), str(len(one.arms)), typical, between.join(named))

    def _drift(self, one: Drift) -> tuple[str, ...]:
        days = [datetime.fromtimestamp(t, UTC).date().isoformat() for t in (one.first, one.last)]
        return (one.arm, *self._what(one.what), self._value(one.slope), " – ".join(days), str(one.count))

    def _news(self, new: News | None) -> list[str]:
        if new is None:
            return [self.t("news_first")]
        lines = [self.t("news_arm", arm=arm) for arm in new.arms]
        for key, pairs in (("news_come", new.come), ("news_gone", new.gone)):
            for arm, what in pairs:
                effect, where = self._what(what)
                lines.append(self.t(key, arm=arm, effect=effect, place=where))
        head = self.t("news_some" if lines else "news_none", count=new.recordings)
        left = [self.t("more", count=len(lines) - 5 * _NAMED)] if len(lines) > 5 * _NAMED else []
        return [head, *lines[: 5 * _NAMED], *left]


def _course(one: Drift) -> dict[str, Any]:
    """Points and line of a drift in a picture's pixels."""
    low = min(min(v - s for _, v, s in one.points), one.start, one.end)
    high = max(max(v + s for _, v, s in one.points), one.start, one.end)
    span, tall = max(one.last - one.first, 1.0), max(high - low, 1e-300)

    def at(t: float, v: float) -> tuple[float, float]:
        return round(4 + (_WIDE - 8) * (t - one.first) / span, 1), round(
            _HIGH - 4 - (_HIGH - 8) * (v - low) / tall, 1
        )

    return {
        "wide": _WIDE,
        "high": _HIGH,
        "points": [at(t, v) for t, v, _ in one.points],
        "line": [at(one.first, one.start), at(one.last, one.end)],
    }
