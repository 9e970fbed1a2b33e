from app.pendant.screens import tool
from app.pendant.server import PendantServer
from app.session import Store
from benchmarks._browser import Browser
from tests.pendant.test_server import pytestmark, until  # noqa: F401  (same worker)


def test_a_screen_that_cannot_be_made_leaves_the_others(tmp_path, monkeypatch):
    def broken(self, pendant):
        raise RuntimeError("broken screen")

    monkeypatch.setattr(type(tool.SCREEN), "build", broken)
    server = PendantServer(Store(tmp_path), port=0, robot="ur10e")
    browser = Browser(server.port)
    try:
        until(lambda: server.pendants and hasattr(server.pendants[0], "page"), "the page")
        pendant = server.pendants[0]
        assert pendant.worker.idle()
        assert any("broken screen" in words for _, _, words in pendant.log)
        pendant.post(lambda: pendant.place(pendant.q + 0.1))
        until(lambda: pendant.worker.idle(0.1), "the arm")
    finally:
        browser.close()
        server.stop()
