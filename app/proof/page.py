"""The scorecard as one page that stands alone and prints."""

from __future__ import annotations

from html import escape

from app.proof.controls import TITLES
from app.proof.intervals import Rate
from app.proof.pictures import histogram, interval_bar
from app.proof.run import Proof, failed, failure
from app.proof.scoring import heldout_summary
from app.proof.table import aim_text

STYLE = """
:root { --ink: #1c2430; --soft: #5c6674; --line: #d8dde4; --good: #1d7f4e; --bad: #b3261e; --accent: #2a62b8; }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); max-width: 1180px; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: .2rem; } h2 { margin-top: 2.4rem; font-size: 1.2rem; }
p.lead, td.soft, .soft { color: var(--soft); } code { background: #f2f4f7; padding: .1em .35em; border-radius: 3px; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .6rem; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; }
th { font-weight: 600; font-size: .85rem; color: var(--soft); } td.n, th.n { text-align: right; }
.met { color: var(--good); font-weight: 600; } .missed { color: var(--bad); font-weight: 600; }
.keep { white-space: nowrap; }
table.heat td, table.heat th { padding: .15rem .3rem; font-size: .74rem; border: 1px solid #fff; }
table.heat th.turn { writing-mode: vertical-rl; transform: rotate(180deg); text-align: left; vertical-align: bottom; }
table.heat td { text-align: center; min-width: 1.4rem; } .scroll { overflow-x: auto; }
table.fails td { font-size: .84rem; } .hash { overflow-wrap: anywhere; }
@media print { body { margin: 0; max-width: none; font-size: 11px; }
  h2 { break-after: avoid; } tr { break-inside: avoid; } }
"""


def page(proof: Proof) -> str:
    """HTML without a reference to anything outside itself."""
    parts = [
        _head(proof),
        "<h2>Rates</h2>",
        _lines(proof),
        "<h2>What was true, and what was said</h2>",
        "<p class=soft>Rows: the effect that was in the recording (in brackets: one that no library holds, none, or "
        "one too faint to be told). Columns: what was said first (in brackets: the verdict, where nothing was named). "
        "Darker: more of that row. Framed: right.</p>",
        _confusion(proof.score.confusion),
        "<h2>Held-out error against the noise floor</h2>",
        _heldout(proof),
        "<h2>Effect by effect</h2>",
        _effects(proof),
        "<h2>Negative controls</h2>",
        _controls(proof),
        "<h2>Failures</h2>",
        _failures(proof),
        "<h2>Again</h2>",
        f"<p>The same cases: <code>{escape(proof.command)}</code>. Fresh ones: leave out the seed. "
        f"{escape(', '.join(f'{k} {v}' for k, v in proof.versions.items()))}. "
        "Rules of the scorer: app/proof/matching.py.</p>",
    ]
    title = f"Teachframe: proof of the {proof.family} diagnosis"
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
        f'<meta name="viewport" content="width=device-width"><style>{STYLE}</style></head>'
        f"<body>{''.join(parts)}</body></html>\n"
    )


def _head(proof: Proof) -> str:
    return (
        f"<h1>Proof of the {proof.family} diagnosis</h1>"
        f"<p class=lead>{len(proof.judged)} sealed cases, seed {proof.seed}. The answers' SHA-256 was printed before "
        f"the first question: <span class=hash><code>{proof.seal}</code></span></p>"
    )


def _lines(proof: Proof) -> str:
    rows = [
        "<tr><th>what</th><th class=n>cases</th><th class=n>rate</th><th>95% interval</th><th></th><th>aim</th>"
        "<th></th></tr>"
    ]
    for line in proof.score.lines:
        mark = {True: "<span class=met>met</span>", False: "<span class=missed>missed</span>", None: ""}[
            line.met
        ]
        rows.append(
            f"<tr><td>{escape(line.title)}</td><td class=n>{line.rate.cases}</td>"
            f"<td class=n>{_percent(line.rate)}</td><td class='soft keep'>{_span(line.rate)}</td>"
            f"<td class=keep>{interval_bar(line.rate, line.aim)}</td>"
            f"<td class='soft keep'>{aim_text(line)}</td><td>{mark}</td></tr>"
        )
    return f"<table>{''.join(rows)}</table>"


def _confusion(confusion) -> str:
    columns = sorted(
        {said for row in confusion.values() for said in row}, key=lambda s: (s.startswith("("), s)
    )
    head = "".join(f"<th class=turn>{escape(c)}</th>" for c in columns)
    rows = [f"<tr><th></th><th class=n>cases</th>{head}</tr>"]
    for true, said in confusion.items():
        total = sum(said.values())
        cells = []
        for column in columns:
            count = said.get(column, 0)
            share = count / total
            right = column == _right(true)
            shade = (
                f"background: rgba(42, 98, 184, {0.08 + 0.92 * share:.2f})"
                if count
                else "background: #f6f7f9"
            )
            ink = "; color: #fff" if share > 0.5 else ""
            frame = "; outline: 2px solid #1d7f4e; outline-offset: -2px" if right else ""
            cells.append(f'<td style="{shade}{ink}{frame}">{count or ""}</td>')
        rows.append(f"<tr><th>{escape(true)}</th><td class=soft>{total}</td>{''.join(cells)}</tr>")
    return f"<div class=scroll><table class=heat>{''.join(rows)}</table></div>"


def _right(true: str) -> str:
    """What should have been said of a row."""
    if true in ("(nothing)", "(too faint)"):
        return "(clean)"
    return "(unexplained)" if true.startswith("(") else true


def _heldout(proof: Proof) -> str:
    ratios = [value for _, value in proof.score.heldout]
    held = heldout_summary(ratios)
    if not held:
        return "<p>No case to show.</p>"
    return (
        f"<p>Error on rows left out, divided by the noise that was really put in, for the cases answered rightly: "
        f"median {held['median']:.3f}, middle half {held['lower_quartile']:.3f} to {held['upper_quartile']:.3f} "
        f"({held['cases']} cases). 1 is the floor; what is fitted costs a little above it. "
        f"Aim: at most {held['aim']:.2f}, {'met' if held['met'] else 'missed'}.</p>"
        + histogram(ratios, low=0.7, high=1.6, floor=1.0)
    )


def _effects(proof: Proof) -> str:
    rows = [
        "<tr><th>effect</th><th class=n>cases</th><th>place</th><th>name</th><th>in the set</th>"
        "<th>95% intervals hold</th></tr>"
    ]
    for name, place, right, listed in proof.score.effects:
        cover = proof.score.coverage.get(name)
        rows.append(
            f"<tr><td>{escape(name)}</td><td class=n>{place.cases}</td><td>{_percent(place)}</td>"
            f"<td>{_percent(right)}</td><td>{_percent(listed)}</td>"
            f"<td>{f'{_percent(cover)} of {cover.cases}' if cover else ''}</td></tr>"
        )
    return f"<table>{''.join(rows)}</table>"


def _controls(proof: Proof) -> str:
    rows = ["<tr><th>control</th><th class=n>asked</th><th class=n>named something</th><th>what</th></tr>"]
    for kind, (rate, wrong) in proof.controls.items():
        mark = "met" if not rate.hits else "missed"
        rows.append(
            f"<tr><td>{escape(TITLES.get(kind, kind))}</td><td class=n>{rate.cases}</td>"
            f"<td class='n {mark}'>{rate.hits}</td><td>{escape('; '.join(wrong))}</td></tr>"
        )
    return f"<table>{''.join(rows)}</table>"


def _failures(proof: Proof) -> str:
    wrong = [failure(case) for case in proof.judged if failed(case)]
    if not wrong:
        return "<p>None.</p>"
    keys = ("case", "stratum", "recording", "true", "verdict", "said", "leftover")
    head = "".join(f"<th>{key}</th>" for key in keys)
    body = "".join("<tr>" + "".join(f"<td>{_cell(row[k])}</td>" for k in keys) + "</tr>" for row in wrong)
    return (
        f"<p>{len(wrong)} of {len(proof.judged)}: a name that is not so, or a truth that survives and was not "
        f"named.</p>"
        f"<table class=fails><tr>{head}</tr>{body}</table>"
    )


def _cell(value: object) -> str:
    if isinstance(value, dict):
        return escape(", ".join(f"{k}={v}" for k, v in value.items()))
    return escape(str(value))


def _span(rate: Rate) -> str:
    low, high = rate.interval
    return f"{low:.1%} to {high:.1%}"


def _percent(rate: Rate) -> str:
    return "" if rate.value is None else f"{rate.value:.1%}"
