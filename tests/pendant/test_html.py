from app.pendant import html

BAD = "<script>alert('x')</script>&\""


def test_nothing_from_outside_becomes_markup():
    pieces = [
        html.paragraph(BAD),
        html.light("red", BAD),
        html.table([(BAD, BAD)], head=(BAD, BAD)),
        html.notes([("red", BAD)]),
        html.item(BAD),
    ]
    for piece in pieces:
        assert "<script" not in piece and "&lt;script" in piece


def test_a_light_names_its_colour_for_those_who_cannot_see_it():
    assert 'data-colour="green"' in html.light("green", "good")


def test_no_remarks_take_no_room():
    assert html.notes([]) == ""
