"""People in a database of their own."""

import pytest

from app.people import People
from app.session import Store

PASSWORD = "correct horse battery"
PIN = "482915"
HERE = "127.0.0.1"


@pytest.fixture
def people(tmp_path):
    return People(Store(tmp_path).database)


def school_of(people):
    """An administrator, two trainers with a class each, a trainee in each class."""
    found = {"administrator": people.add("admin", "Ada", "administrator", PASSWORD)}
    for number in (1, 2):
        trainer = people.add(f"trainer{number}", f"Trainer {number}", "trainer", PASSWORD)
        at = people.classes.make(f"Class {number}", trainer.id)
        trainee = people.join(at.code, f"Trainee {number}", PIN, HERE)
        found |= {f"trainer{number}": trainer, f"class{number}": at, f"trainee{number}": trainee}
    return found


@pytest.fixture
def school(people):
    return school_of(people)
