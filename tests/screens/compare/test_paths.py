"""Files of the server's folder are read by whom the server belongs to, and by nobody who logs in at it."""

from app.people import People
from app.session import Store
from app.workers.hub import Hub


def labels(live):
    live.context.worker.idle()
    return {widget.label for widget in live.context.ui.widgets()}


def test_a_path_is_offered_without_accounts_alone(tmp_path):
    store = Store(tmp_path)
    tom = People(store.database).add("tom", "Tom", "trainee", "correct horse battery")
    hub = Hub(store, robot="ur10e")
    alone, learner = labels(hub.enter("somebody on this machine")), labels(hub.enter(tom.owner, person=tom))
    hub.close()
    assert alone - learner == {"Or a path", "Load from the path"}
    assert "Drop a recording and its URDF" in learner
