from app.screens import tool
from tests.desk import until


def test_a_screen_that_cannot_be_made_leaves_the_others(sit_at, monkeypatch):
    def broken(self, context):
        raise RuntimeError("broken screen")

    monkeypatch.setattr(type(tool.SCREEN), "build", broken)
    desk = sit_at()
    assert any("broken screen" in words for _, _, words in desk.context.log)
    assert "Two robots" in desk.shown()
    with desk.holding():
        desk.live.joint(0, 5.0)
        until(lambda: desk.context.worker.running("move"), "the arm")
        desk.rests()
