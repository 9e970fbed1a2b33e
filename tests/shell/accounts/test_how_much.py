"""How much somebody may ask and send; others go on meanwhile."""

from app.people import limits
from app.people.bulk import Bulk
from app.people.meter import Meter
from tests.shell.conftest import ORIGIN


def test_who_asks_more_than_any_page_waits_and_the_others_do_not(browser, school):
    client = browser(school["trainee1"])
    flow = client.app._app.flow
    flow._strange = Meter(limits.Limit(5, 1e6))
    stranger = browser()
    answers = [stranger.get("/static/frame.css").status_code for _ in range(8)]
    assert answers == [200] * 5 + [429] * 3
    assert client.get("/account").status_code == 200
    flow._known = Meter(limits.Limit(2, 1e6))
    assert [client.get("/account").status_code for _ in range(3)] == [200, 200, 429]


def test_a_person_sends_so_much_an_hour_and_so_many_drops_at_once(browser, school, hub, people, shell):
    client = browser(school["trainee1"])
    client.get("/")
    live = hub.find(school["trainee1"].owner)
    live.context.ui.takes_files = lambda number: True
    send = lambda drop, size: client.put(f"/upload/1/{drop}", content=b"x" * size, headers=ORIGIN).status_code  # noqa: E731
    drops = shell._drops
    assert [send(f"d{k}", 10) for k in range(limits.DROPS + 2)] == [204] * (limits.DROPS + 2)
    assert len(drops._drops) == limits.DROPS and len(list(drops._folder.iterdir())) == limits.DROPS
    drops._sent = Bulk(people.tries, limits.Limit(100, 3000.0), piece=10)
    assert [send("e1", 60), send("e1", 60)] == [204, 429]
    assert send("x" * 65, 1) == 404 and send("..", 1) in (404, 405)
