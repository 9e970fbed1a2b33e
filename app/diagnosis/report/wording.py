"""Names, places and numbers as a person writes them. No markup here: text and page share it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from app.diagnosis.judging import BARE, WITH
from app.diagnosis.quantity import quantity
from app.diagnosis.result import Diagnosis, Finding, Judged
from app.diagnosis.wording import FALLBACK, WORDS, in_words
from app.units import deg, mm

#: What is in the simulation while a given model is judged -> the key of its words.
_STEPS = {BARE: "judged.bare", WITH: "judged.with"}
_NEARLY_ALL = 0.99
#: What a place may be made of and has words of its own; a model from elsewhere may bring more, which stand as they are.
PLACES = frozenset(
    {"body", "reflector", "joint", "link", "axis", "source_joint"}
    | {"driver", "order", "kind", "from_row", "from_s", "to_s"}
)


def effect_title(key: str, language: str = FALLBACK) -> str:
    """`joint_compliance` -> "Joint compliance"."""
    name = f"effect.{key}"
    return WORDS.text(name, language) if WORDS.has(name) else key.replace("_", " ").capitalize()


def parameter_name(key: str, language: str = FALLBACK) -> str:
    """`com_x` -> "com x"."""
    name = f"parameter.{key}"
    return WORDS.text(name, language) if WORDS.has(name) else key.replace("_", " ")


def noise_source(key: str, language: str = FALLBACK) -> str:
    """How the noise is known, in words."""
    return WORDS.text(f"noise.{key}", language)


def judged_step(what: str, language: str = FALLBACK) -> str:
    """What is in the simulation while a given model is judged."""
    return WORDS.text(_STEPS[what], language) if what in _STEPS else what


def judged_rows(judged: Judged, language: str = FALLBACK) -> list[tuple[str, str, str]]:
    """Each step of a given model's judgement: what is in, its error, how much smaller than before."""
    first = next(iter(judged.steps.values()))
    return [
        (
            judged_step(what, language),
            measure(q.heldout_rms, q.unit),
            "" if q is first else fall(first.heldout_rms, q.heldout_rms, language),
        )
        for what, q in judged.steps.items()
    ]


def place(where: Mapping[str, Any], language: str = FALLBACK) -> str:
    """`where` in words: "joint 2, driven by its gravity torque"."""

    def said(key: str, **fields: Any) -> str:
        return WORDS.text(f"place.{key}", language, **fields)

    parts: list[str] = []
    if where.get("body") is not None:
        body = f"body.{where['body']}"
        parts.append(WORDS.text(body, language) if WORDS.has(body) else str(where["body"]))
    if where.get("reflector") is not None:
        parts.append(said("reflector", n=where["reflector"]))
    if where.get("joint") is not None:
        parts.append(said("joint", n=where["joint"]))
    if where.get("link") is not None and where.get("axis") is not None:
        parts.append(said("link_axis", n=where["link"], axis=where["axis"]))
    elif where.get("link") is not None:
        parts.append(said("link", n=where["link"]))
    if where.get("source_joint") is not None:
        # Two joints that are changed over move nothing in each other.
        parts.append(said("source" if where.get("kind") is None else "with_joint", n=where["source_joint"]))
    if where.get("driver") is not None:
        key = f"driver.{where['driver']}"
        driver = WORDS.text(key, language) if WORDS.has(key) else str(where["driver"]).replace("_", " ")
        # Without a joint to belong to, "its" has nothing to point at.
        parts.append(said("driven", driver=driver if where.get("joint") else driver.removeprefix("its ")))
    if where.get("order") is not None:
        parts.append(said("order", n=where["order"]))
    if where.get("kind") is not None:
        kind = f"kind.{where['kind']}"
        parts.append(WORDS.text(kind, language) if WORDS.has(kind) else str(where["kind"]).replace("_", " "))
    if where.get("from_row") is not None:
        parts.append(said("from_row", n=where["from_row"]))
    if where.get("from_s") is not None and where.get("to_s") is not None:
        parts.append(said("window", start=f"{where['from_s']:.2f}", end=f"{where['to_s']:.2f}"))
    elif where.get("from_s") is not None:
        parts.append(said("since", start=f"{where['from_s']:.2f}"))
    parts += [f"{key.replace('_', ' ')} {value}" for key, value in where.items() if key not in PLACES]
    return WORDS.text("list.between", language).join(parts) or said("nowhere")


def rivals(finding: Finding, language: str = FALLBACK) -> str:
    """Other explanations that the recording does not rule out, as one set; "" where there are none."""
    return WORDS.text("page.found.between", language).join(
        WORDS.text(
            "page.found.alternative",
            language,
            effect=effect_title(a.effect, language),
            where=place(a.where, language),
            delta=f"{a.delta_bic:+.1f}",
        )
        for a in finding.alternatives
    )


def finding_sentence(finding: Finding, language: str = FALLBACK) -> str:
    """What was found in one sentence: the effect's own in English, place, effect and values elsewhere."""
    if not WORDS.has("sentence.found", language):
        return finding.sentence
    values = WORDS.text("list.between", language).join(
        f"{parameter_name(p.name, language)} {quantity(p, language)}" for p in finding.parameters
    )
    fields = {"where": place(finding.where, language), "effect": effect_title(finding.effect, language)}
    if not values:
        return WORDS.text("sentence.found_bare", language, **fields)
    return WORDS.text("sentence.found", language, values=values, **fields)


def finding_law(finding: Finding, language: str = FALLBACK) -> str:
    """The law, its words and the names of its parameters in a language."""
    for family in ("static", "motion"):
        key = f"law.{family}.{finding.effect}"
        if WORDS.has(key) and WORDS.text(key) == finding.equation:
            return WORDS.text(key, language)
    return in_words(finding.equation, language)


def measure(value: float, unit: str) -> str:
    """A length of error, a torque or an angle, with three digits: "0.151 mm"."""
    if value is None or not math.isfinite(value):
        return "–"
    return f"{digits(value)} {unit}"


def digits(value: float, figures: int = 3) -> str:
    """Three figures without an exponent where a person would write none."""
    if value == 0 or not math.isfinite(value):
        return "0" if value == 0 else "–"
    exponent = math.floor(math.log10(abs(value)))
    if -4 <= exponent < 6:
        return f"{value:.{max(figures - 1 - exponent, 0)}f}"
    return f"{value:.{figures - 1}e}"


def probability(p: float, language: str = FALLBACK) -> str:
    """ "p = 0.005", or "p < 0.0001" where the number itself says nothing more."""
    if p is None or not math.isfinite(p):
        return WORDS.text("probability.unknown", language)
    return "p < 0.0001" if p < 1e-4 else f"p = {p:.2g}"


def verdict_sentence(diagnosis: Diagnosis, language: str = FALLBACK) -> str:
    """The verdict in one sentence."""
    if diagnosis.verdict == "clean":
        return WORDS.text("verdict.clean", language)
    where = place(diagnosis.leftover.where, language)
    if diagnosis.verdict == "unexplained":
        return WORDS.text("verdict.unexplained", language, where=where)
    count = len(diagnosis.findings)
    word = f"count.{count}"
    number = WORDS.text(word, language) if WORDS.has(word) else str(count)
    what = WORDS.text("verdict.one" if count == 1 else "verdict.many", language, count=number)
    if diagnosis.verdict == "partly":
        return WORDS.text("verdict.partly", language, what=what[:1].upper() + what[1:], where=where)
    return WORDS.text("verdict.named_one" if count == 1 else "verdict.named_many", language, what=what)


def joint_values(q: Sequence[float], prismatic: Sequence[bool] = ()) -> str:
    """One pose: degrees for turning joints, millimetres for sliding ones."""
    slides = list(prismatic) or [False] * len(q)
    return "  ".join(f"{mm(v):.1f} mm" if s else f"{deg(v):.1f}°" for v, s in zip(q, slides, strict=True))


def fall(before: float, after: float, language: str = FALLBACK) -> str:
    """How much smaller: "82% smaller", "unchanged"."""
    if not (math.isfinite(before) and math.isfinite(after)) or before <= 0:
        return ""
    share = 1 - after / before
    if abs(share) < 0.005:
        return WORDS.text("fall.unchanged", language)
    if share > _NEARLY_ALL:
        return WORDS.text("fall.over", language, share=f"{_NEARLY_ALL:.0%}")
    return WORDS.text("fall.smaller" if share > 0 else "fall.larger", language, share=f"{abs(share):.0%}")
