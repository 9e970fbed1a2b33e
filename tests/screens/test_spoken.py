"""Who chooses another language finds the log in it: what was said before, too, with the names in it."""

from app.screens import spoken
from app.session.actions import ChooseMode
from app.texts import text
from tests.chinese import CHINESE


def lines(desk):
    return [words for _, _, words in desk.context.log]


def test_the_lines_of_the_log_change_their_language_and_come_back(desk):
    view = desk.view("deciding")
    desk.does(lambda: desk.context.do(ChooseMode("touch_zx", 4)))
    desk.moves(view._help)
    desk.does(view._record_next)
    desk.does(lambda: desk.context.say("info", "a name that nobody translates"))
    before = lines(desk)
    assert any("Touch 1 recorded" in words for words in before)
    desk.live.choose("language", "zh")
    desk.idle()
    changed = lines(desk)
    assert all(CHINESE.search(words) for words in changed if "nobody" not in words), changed
    assert not any("Touch 1" in words for words in changed)  # the name in it is the paper's Chinese one
    desk.live.choose("language", "en")
    desk.idle()
    assert lines(desk)[: len(before)] == before


def test_no_more_is_remembered_than_a_log_needs(monkeypatch):
    monkeypatch.setattr(spoken, "_MOST", 3)
    said = spoken.Spoken()
    words = [said.text("message.given", "en", {"name": str(k)}) for k in range(4)]
    assert said.said(words[0], "zh") == words[0]
    assert said.said(words[3], "zh") == text("message.given", "zh", name="3")
