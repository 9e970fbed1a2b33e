"""Tables as spreadsheets and learning platforms read them."""

import csv
import io

import pytest

from app.classroom.grades import Row, canvas_csv, moodle_csv, scores_csv
from app.classroom.progress import Lesson, Standing
from app.training.exercise import exercise

LESSONS = [Lesson("a", "first_tool", exercise("first_tool")), Lesson("b", "bent_tip", exercise("bent_tip"))]
ROWS = [
    Row("Ada, Countess", "ada", {"a": Standing(2, 81.25, True, 0.4, 300.0, 0.0, 12.5)}),
    Row("Bo", "bo@school.example", {}),
]


def read(text):
    return list(csv.reader(io.StringIO(text)))


def test_moodle_gets_a_column_that_says_who_and_one_a_lesson():
    """Moodle: head, a row a person, `-` where there is no grade."""
    assert read(moodle_csv(ROWS, LESSONS, "en")) == [
        ["Full name", "Username", "My first tool point", exercise("bent_tip").said("en").title],
        ["Ada, Countess", "ada", "81.2", "-"],
        ["Bo", "bo@school.example", "-", "-"],
    ]


def test_canvas_gets_its_five_columns_in_order_and_the_points_possible():
    """Canvas: row[0] holds Student, row[1] ID, then SIS User ID, SIS Login ID, Section; second row Points Possible."""
    head, possible, ada, bo = read(canvas_csv(ROWS, LESSONS, "en", "Monday"))
    assert head[:5] == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"] and len(head) == 7
    assert possible == ["Points Possible", "", "", "", "", "100", "100"]
    assert ada == ["Ada, Countess", "", "", "ada", "Monday", "81.2", ""]
    assert bo[5:] == ["", ""]


def test_scores_have_a_row_a_trainee_and_lesson():
    rows = [
        dict(zip(read(scores_csv(ROWS, LESSONS, "zh"))[0], r, strict=True))
        for r in read(scores_csv(ROWS, LESSONS, "zh"))[1:]
    ]
    assert len(rows) == 4 and rows[0]["best"] == "81.2" and rows[0]["last_error_mm"] == "0.400"
    assert rows[0]["trend_points_per_try"] == "12.50" and rows[0]["title"] == "第一个工具点"
    assert rows[3]["tries"] == "0" and rows[3]["best"] == ""


def test_two_lessons_of_one_title_are_two_columns():
    twice = [LESSONS[0], Lesson("c", "first_tool", exercise("first_tool"))]
    assert read(moodle_csv(ROWS, twice, "en"))[0][2:] == ["My first tool point", "My first tool point 2"]


@pytest.mark.parametrize("name", ["=1+1", "+A1", "@SUM(A1)", "-2+3", "\t=1"])
def test_a_name_is_no_formula(name):
    for text in (
        moodle_csv([Row(name, name, {})], LESSONS, "en"),
        canvas_csv([Row(name, name, {})], LESSONS, "en", name),
    ):
        assert not [cell for row in read(text) for cell in row if cell.startswith(name)]


def test_a_falling_trend_stays_a_number():
    falling = [Row("Ada", "ada", {"a": Standing(2, 50.0, trend=-3.5)})]
    assert "-3.50" in read(scores_csv(falling, LESSONS, "en"))[1]
