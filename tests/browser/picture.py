"""Makes the README's picture from the running program: `python -m tests.browser.picture OUT.png`."""

import sys
import tempfile
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

from app.pendant.server import PendantServer
from app.session import Store
from tests.browser.conftest import FLAGS, SCREEN, chromium_path
from tests.browser.operator import Operator


def take(out: Path) -> None:
    """The pendant with the result of the paper's table."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        server = PendantServer(Store(Path(folder)), port=0)
        browser = playwright.chromium.launch(executable_path=chromium_path(), args=FLAGS)
        try:
            person = Operator(browser.new_context(viewport=SCREEN).new_page(), server)
            person.click("Load the paper's table")
            person.until(lambda: person.state.result is not None, "the result")
            person.at_rest()
            person.close_notice()
            person.page.wait_for_timeout(3000)
            person.close_notice()
            person.page.wait_for_timeout(1000)
            out.parent.mkdir(parents=True, exist_ok=True)
            person.page.screenshot(path=str(out))
            make_light(out)
        finally:
            browser.close()
            server.stop()


def make_light(path: Path) -> None:
    """Drops the two lowest bits of every colour: nobody sees them, and they are a quarter of the file."""
    picture = Image.open(path).convert("RGB")
    picture.point([min(255, (v + 2) // 4 * 4) for v in range(256)] * 3).save(path, optimize=True)


if __name__ == "__main__":
    take(Path(sys.argv[1] if len(sys.argv) > 1 else "static/pictures/pendant.png"))
