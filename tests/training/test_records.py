"""Scores of many at once."""

from app.session import Store
from app.training.exercise import exercise
from app.training.records import Records
from tests.training.trainee import GOOD


def test_histories_of_many_are_those_of_each(tmp_path):
    records = Records(Store(tmp_path).database)
    for who, key, seed in (("a", "first_tool", 1), ("b", "first_tool", 2), ("a", "bent_tip", 3)):
        records.add(who, "s", GOOD.scores(exercise(key), seed))
    assert records.histories(["a", "b", "c"]) == {"a": records.history("a"), "b": records.history("b")}
    assert records.histories(["a"], "bent_tip") == {"a": records.history("a", "bent_tip")}
