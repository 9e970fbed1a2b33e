"""The card of a given model: its error on this recording, step by step."""

from types import SimpleNamespace

import pytest

from app.diagnosis.result import Judged, Quality
from app.screens._compare import cards
from app.texts import text


@pytest.mark.parametrize(("language", "smaller"), [("en", "75% smaller"), ("zh", "75%")])
def test_the_card_shows_the_error_with_and_without_the_model(language, smaller):
    pendant = SimpleNamespace(language=language, t=lambda key, **fields: text(key, language, **fields))
    steps = {"description alone": Quality(0.9, 1.0, "mm"), "with the model": Quality(0.2, 0.25, "mm")}
    shown = cards.judged(pendant, Judged("folder/run_a.csv", steps))
    for words in ("run_a.csv", "1.00 mm", "0.250 mm", smaller):
        assert words in shown, shown
    assert "folder/" not in shown
