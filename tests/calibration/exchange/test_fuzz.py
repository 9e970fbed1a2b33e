"""Whatever stands in a tool frame's text, only the project's own errors come out, in one line."""

import contextlib
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.calibration.exchange import ToolFrame, exchange_format, formats
from app.errors import TeachframeError
from tests.calibration.exchange.test_every_format import EXPECTED, MORE_TEXTS, TEXTS
from tests.calibration.fuzzing import EXAMPLES, mangled

SOON_S = 1.0  # a search that tries every way of cutting a row takes minutes

#: Good texts of every format, to be spoilt.
GOOD = {
    key: [
        exchange_format(key).write(ToolFrame("torch", EXPECTED, 2.0, (0.0, 0.0, 0.1))),
        TEXTS[key],
        *(text for other, text in MORE_TEXTS.values() if other == key),
    ]
    for key in formats()
}


@pytest.mark.parametrize("key", formats())
@settings(max_examples=EXAMPLES["an importer"], deadline=None)
@given(st.data())
def test_whatever_stands_in_a_text_only_the_projects_errors_come_out(key, data):
    text = data.draw(st.one_of(st.text(max_size=200), st.sampled_from(GOOD[key]).flatmap(mangled)))
    form = exchange_format(key)
    form.knows(text)
    try:
        found = form.read(text)
    except TeachframeError as error:
        assert "\n" not in str(error)
    else:
        assert np.isfinite(found.pose.matrix).all()
        np.testing.assert_allclose(found.pose.rotation.T @ found.pose.rotation, np.eye(3), atol=1e-2)


@pytest.mark.parametrize("piece", ["0" * 400, " " * 400, "\n" * 400])
@pytest.mark.parametrize("key", formats())
def test_a_long_row_of_digits_or_blanks_anywhere_takes_no_time(key, piece):
    form, begun = exchange_format(key), time.process_time()
    for good in GOOD[key]:
        for at in range(0, len(good), 9):
            text = good[:at] + piece + good[at:]
            form.knows(text)
            with contextlib.suppress(TeachframeError):
                form.read(text)
    assert time.process_time() - begun < SOON_S


def test_the_readers_are_given_ten_thousand_texts_a_run():
    counts = dict(EXAMPLES)
    assert counts.pop("an importer") * len(formats()) + sum(counts.values()) >= 10_000
