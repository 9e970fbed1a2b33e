"""What an exercise takes away is gone from the page."""

import re

from app.pendant.aids import Aids
from tests.pendant.test_server import pytestmark  # noqa: F401  (same worker)

MILLIMETRES = re.compile(r"\d mm")


def given(pendant):
    """Labels and options of all widgets of the page."""
    shown = set()
    for handle in pendant.client.gui._gui_input_handle_from_uuid.values():
        if handle.visible:
            shown |= {handle.label, *(getattr(handle, "options", None) or ())}
    return shown


def status(pendant):
    pendant.page.numbers()
    return pendant.layout._status.content


def test_without_aids_no_distance_no_near_view_no_proposal_and_no_handle(open_pendant):
    pendant = open_pendant()
    nearby = {"Tip", "Side", "Front", "Handle", "Show handle", "Go to the ghost"}
    assert nearby <= given(pendant) and pendant.stage.handle.visible
    assert MILLIMETRES.search(status(pendant))
    pendant.post(lambda: pendant.allow(Aids(False, False, False, False)))
    assert pendant.worker.idle()
    assert not nearby & given(pendant) and "Cell" in given(pendant)
    assert not pendant.stage.handle.visible
    assert not MILLIMETRES.search(status(pendant)) and "not touching" in status(pendant)
    pendant.post(lambda: pendant.allow(Aids()))
    assert pendant.worker.idle()
    assert nearby <= given(pendant)


def test_without_the_distance_a_far_record_is_warned_of_without_a_number(open_pendant):
    pendant = open_pendant()
    pendant.post(lambda: pendant.allow(Aids(distance=False)))
    assert pendant.worker.idle()
    tool = next(view for view in pendant.page._views if hasattr(view, "_record"))
    pendant.post(lambda: tool._record(pendant.session.state.steps[0]))
    assert pendant.worker.idle()
    level, words = pendant.log[-1][1:]
    assert level == "warning" and not MILLIMETRES.search(words)
