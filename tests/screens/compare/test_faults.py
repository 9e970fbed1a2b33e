"""A fault in the process that reads ends the reading: bar and button that gives it up stood there for ever."""

from app.screens._compare import reading


def test_after_a_fault_nothing_is_being_read_any_more_and_it_is_told(sit_at, monkeypatch):
    def broken(*_, **__):
        raise RuntimeError("the process never began")

    monkeypatch.setattr(reading, "apart", broken)
    desk = sit_at(robot="ur10e")
    view = desk.view("_sources")
    part = view._sources.reading
    desk.does(lambda: part.start("Reading run.csv…", lambda: None))
    desk.idle()
    assert not (part._bar.visible or part._cancel.visible)
    assert desk.said[0] == "error" and "never began" in desk.said[1]
