"""What somebody sends is read in a process of its own: the arm moves and stops meanwhile, and it can be given up."""

import os
import time

from app.screens import taking_in
from app.screens._compare import sources
from app.screens._compare.jobs import Arrived
from app.screens._compare.kept import kept_for
from tests.desk import until
from tests.shell.test_files import send, upload_of
from tests.test_apart import alive

PROMPT_S = 0.5  # a click is heard, on a machine on which other tests run
DROP = "Drop a recording and its URDF"


def never_ends(files, folder, robot, model, say):
    (folder.parent / "pid").write_text(str(os.getpid()))
    say(0.3, "reading")
    end = time.monotonic() + 120.0
    while time.monotonic() < end:  # at work, not asleep
        pass
    return Arrived(None, None)


def shown(page, testid):
    return any(w.get("visible", True) and testid in w.get("content", "") for w in page.state()["widgets"])


def press(page, label):
    number = next(
        w["id"] for w in page.state()["widgets"] if w.get("label") == label and w.get("visible", True)
    )
    page.say(t="press", id=number)


def test_while_a_file_is_read_the_arm_moves_stops_and_the_file_can_be_given_up(page, brisk, monkeypatch):
    monkeypatch.setattr(sources, "read_drop", never_ends)
    assert send(page, upload_of(page, DROP)).status_code == 204
    until(lambda: any("reading, 30%" in w.get("content", "") for w in page.state()["widgets"]), "the figure")
    context = page.live.context

    start = page.q
    page.hold(0.6, en=True, axis=0, sign=1, press=1)
    assert abs(page.q - start).max() > 0.0
    done = []
    asked = time.monotonic()
    context.post(lambda: done.append(time.monotonic()))
    until(lambda: done, "the worker")
    assert done[0] - asked < PROMPT_S
    page.say(t="stop")
    until(lambda: context.drive.how == "stopped", "the stop", PROMPT_S)

    pid = next(int(p.read_text()) for p in _folder(page).glob("**/pid"))
    assert alive(pid)
    press(page, "Give up reading")
    until(lambda: not alive(pid), "the end of the process")
    until(lambda: "Given up" in context.log[-1][2], "the word of it")
    assert not shown(page, "compare-reading")


def _folder(page):
    return kept_for(page.live.session.name).folder


def test_a_file_that_is_no_recording_is_refused_by_name_and_nothing_else_happens(page):
    assert send(page, upload_of(page, DROP), content=b"\x00\x01nothing").status_code == 204
    context = page.live.context
    until(lambda: context.log[-1][1] == "warning", f"the refusal; {context.log[-1]}")
    assert "binary" in context.log[-1][2] and "/" not in context.log[-1][2]
    assert not shown(page, "compare-reading")


def test_points_a_tool_a_model_and_a_session_are_read_apart_too(page, monkeypatch):
    """The reader's own fault below Python would end its process; here each is refused by name."""
    asked = []
    whole = taking_in.apart

    def noted(job, *given, **named):
        asked.append(getattr(job, "func", job).__name__)  # some are partial: with the person's own arms
        return whole(job, *given, **named)

    monkeypatch.setattr(taking_in, "apart", noted)
    for label in ("Load a points file", "Load a tool frame", "Send a model file", "Import a session"):
        assert send(page, upload_of(page, label), content=b"{[(nonsense").status_code == 204
    until(lambda: len(asked) == 4, f"all readers; {asked}")
    assert set(asked) == {"load_action", "read_frame", "load_model", "replayable"}
