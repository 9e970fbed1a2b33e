"""Figures as they are read: no sign before nothing, and no unit on a line of its own."""

import pytest

from app.figures import NO_BREAK, finished, in_markup, together, unsigned
from app.panel import Panel, Row
from app.panel import markup as html
from app.phrases import FALLBACK
from app.shell import readable
from app.templating import templates
from app.texts import TEXTS


@pytest.mark.parametrize(
    "text, read",
    [
        ("-0.00°", "0.00°"),
        ("at (1.00, -0.00, -0.01) mm", "at (1.00, 0.00, -0.01) mm"),
        ("x      -0.000   ± 0.1", "x       0.000   ± 0.1"),  # a column keeps its place
        (" -0.0\n  -0.0", "  0.0\n   0.0"),
        ("-0 of 4", "0 of 4"),
        ("it is -0.00.", "it is 0.00."),
    ],
)
def test_what_rounds_to_nothing_has_no_sign(text, read):
    assert unsigned(text) == read


@pytest.mark.parametrize(
    "text",
    [
        "-0.05",
        "-0.0e5",
        "-10.0",
        "2026-01-01",
        "run-0",
        "run_-0.csv",
        "'-0.00' is no mass",
        "1-0",
        "--0",
        "-0.00001",
    ],
)
def test_what_is_no_zero_with_a_sign_stays(text):
    assert unsigned(text) == text


@pytest.mark.parametrize(
    "text",
    [
        "0.2 mm",
        "12.5 °",
        "± 0.05 mm",
        "250 mm/s",
        "3 kg",
        "5 min",
        "0.3 毫米",
        "20 %",
        "0.0076 kg m",
        "2 kg m²",
    ],
)
def test_a_number_is_not_parted_from_its_unit(text):
    assert together(f"so {text} at") == f"so {text.replace(' ', NO_BREAK)} at"


@pytest.mark.parametrize("text", ["4 more", "3 mast", "touch 2 moved", "row 5 is", "2 stands", "mm 3"])
def test_words_after_a_number_may_stand_on_the_next_line(text):
    assert together(text) == text


def test_tags_pictures_and_styles_stay_as_they_are():
    around = '<path d="M 0 5 m 3 4"/><style>p { margin: -0 3 mm }</style><p title="5 mm">'
    assert in_markup(f"{around}-0.0 mm</p>") == f"{around}0.0{NO_BREAK}mm</p>"


def test_what_is_sent_back_or_copied_stays_as_it_stands_and_so_does_what_is_cited():
    for name in ("textarea", "code", "pre"):
        kept = f'<{name} name="x">load = -0.00 mm <b>5 mm</b></{name}>'
        assert in_markup(f"{kept}<p>5 mm</p>") == f"{kept}<p>5{NO_BREAK}mm</p>"
    cited = str(html.Markup.escape("'-0.00' is no mass, \"-0.0\" is none"))
    assert in_markup(cited) == cited


@pytest.mark.parametrize("number", ["0.2 mm", "-1.5 mm", "3.0 °"])
def test_a_number_that_is_copied_from_a_page_is_still_a_number(number):
    value, unit = together(number).split()
    assert float(value) == float(number.split()[0]) and unit == number.split()[1]
    assert float(together(number).removesuffix(unit)) == float(value)


def test_a_template_puts_figures_as_they_are_read_and_leaves_what_forms_bring_back():
    report, form = templates(__file__), templates(__file__, forms=True)
    source = "<td>{{ text }}</td>{{ ready }}"
    fields = {"text": "-0.00 mm", "ready": html.Markup("<b>-0 mm</b>")}
    assert report.from_string(source).render(fields) == f"<td>0.00{NO_BREAK}mm</td><b>-0 mm</b>"
    assert form.from_string(source).render(fields) == "<td>-0.00 mm</td><b>-0 mm</b>"
    assert finished(-0.0) == 0.0
    # A command is copied into a shell: escaped by name it is finished, and stays as it is typed.
    assert report.from_string("<code>{{ text|e }}</code>").render(fields) == "<code>-0.00 mm</code>"


@pytest.mark.parametrize("language", [FALLBACK, "zh"])
def test_sentences_have_no_signed_nothing(language):
    told = TEXTS.text("load.truth", language, kg="1.0", centre="-0.0, 3.0, -0.0")
    assert "-0" not in told and "3.0" in told


def test_the_page_gets_every_word_it_draws_unbroken_and_every_value_as_it_is():
    panel = Panel()
    panel.add_html(html.table([("X", "-0.00 mm")]))
    panel.add_button("Move 150 mm", hint="at 250 mm/s")
    panel.add_choice("step of 1 mm", ("1 mm", "10 mm"))
    panel.add_rows((Row("touch1", "Touch 1", note="misses by 0.2 mm", actions=(("go", "Go"),)),))
    text, button, choice, rows = map(readable.widget, panel.widgets())
    assert f">0.00{NO_BREAK}mm<" in text.content
    assert button.label == f"Move 150{NO_BREAK}mm" and button.hint == f"at 250{NO_BREAK}mm/s"
    assert choice.label == f"step of 1{NO_BREAK}mm"
    assert choice.options == ("1 mm", "10 mm") and choice.value == "1 mm"  # the page says them back
    assert rows.rows[0].note == f"misses by 0.2{NO_BREAK}mm"
