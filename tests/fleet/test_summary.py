"""Which arms share what, what drifts, what is new; nothing of a file becomes markup."""

import numpy as np

from app.fleet.summary import as_page, as_text, summarised
from app.fleet.summary.news import News
from app.fleet.wording import WORDS
from tests.chinese import CHINESE, english_left
from tests.fleet.making import row
from tests.translations import unlike


def test_an_effect_is_an_arms_where_half_its_recordings_have_it():
    rows = [row(arm, day) for arm in ("A", "B") for day in (0, 1)]
    rows += [row("C", 0), row("C", 1, effect=None), row("C", 2, effect=None), row("D", 0, joint=3)]
    found = summarised(rows)
    assert [(s.what.place["joint"], s.arms) for s in found.shared] == [(2, ("A", "B")), (3, ("D",))]
    assert "from_row" not in found.shared[0].what.place


def test_a_value_that_grows_is_named_with_its_slope_and_one_that_stands_is_not():
    rng = np.random.default_rng(3)
    rows = [row("still", 30 * k, value=3e-5 + 1e-6 * rng.normal()) for k in range(12)]
    rows += [row("worn", 30 * k, value=3e-5 + 1e-6 * k + 1e-6 * rng.normal()) for k in range(12)]
    found = summarised(rows)
    (drift,) = found.drifts
    assert (drift.arm, drift.count, found.series) == ("worn", 12, 2)
    a_month = 1e-6 * 365.25 / 12 / 30
    assert abs(drift.slope.value - a_month) < 4 * drift.slope.std < 1e-6


def test_two_hundred_values_that_stand_give_no_drift():
    rng = np.random.default_rng(11)
    rows = [row(f"{a}", 30 * k, value=3e-5 + 1e-6 * rng.normal()) for a in range(200) for k in range(5)]
    found = summarised(rows)
    assert found.series == 200 and not found.drifts


def test_scatter_beyond_the_errors_is_no_drift():
    rng = np.random.default_rng(5)
    rows = [row("rough", 30 * k, value=3e-5 + 1e-5 * rng.normal(), std=1e-8) for k in range(8)]
    assert not summarised(rows).drifts


def test_what_the_last_run_brought_is_said_beside_all_before():
    rows = [row("A", 0), row("B", 0), row("A", 30, run=2), row("A", 31, run=2, joint=4)]
    rows += [row("B", 30, run=2, effect=None), row("C", 30, run=2)]
    new = summarised(rows).news
    assert (new.recordings, new.arms) == (4, ("C",))
    assert [(arm, what.place["joint"]) for arm, what in new.come] == [("A", 4)]
    assert [(arm, what.place["joint"]) for arm, what in new.gone] == [("B", 2)]
    assert summarised(rows[:2]).news is None
    nothing = summarised(rows[:2], run=2)
    assert nothing.news == News(0, (), (), ()) and "first run" not in as_text(nothing)


def test_no_text_of_a_file_becomes_markup():
    evil = "<script>alert(1)</script>"
    rows = [row(evil, 30 * k, value=3e-5 + 1e-5 * k) for k in range(6)] + [row("x", 0, error=f"{evil}: no")]
    rows += [row("new" + evil, 400, run=2), row("m", 0, effect=evil)]
    page = as_page(summarised(rows))
    assert "<script" not in page and page.count("&lt;script&gt;") >= 4


def test_both_languages_say_all_and_chinese_says_it_in_chinese():
    english, chinese = (WORDS.languages[name] for name in ("en", "zh"))
    assert not unlike(english, chinese) and not unlike(chinese, english)
    rows = [row("甲", 30 * k, value=3e-5 + 1e-5 * k, run=1 + k // 5) for k in range(6)] + [
        row("乙", 1, run=2)
    ]
    for said in (as_text(summarised(rows), "zh"), as_page(summarised(rows), "zh").split("</style>")[1]):
        assert CHINESE.search(said)
    text = as_text(summarised(rows), "zh")
    assert english_left(text, names=["µrad"]) == []
