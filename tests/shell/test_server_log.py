"""What stands in the server's log is worth reading: who is turned away is no fault of the program."""

import logging
import time

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from app.session import Store
from app.shell.server import PendantServer

pytestmark = pytest.mark.xdist_group("pendant_server")


class _Kept(logging.Handler):
    def __init__(self):
        super().__init__(logging.WARNING)
        self.said = []

    def emit(self, record):
        self.said.append(record.getMessage())


def test_a_socket_from_elsewhere_is_refused_without_a_fault_in_the_log(tmp_path):
    server, kept = PendantServer(Store(tmp_path), port=0, robot="ur10e"), _Kept()
    log = logging.getLogger("uvicorn.error")
    log.addHandler(kept)
    try:
        for _ in range(3):
            with pytest.raises(InvalidStatus) as refused:
                connect(f"ws://127.0.0.1:{server.port}/words", origin="https://evil.example")
            assert refused.value.response.status_code == 403
        time.sleep(0.1)  # it was said after the answer
    finally:
        server.stop()
        log.removeHandler(kept)
    assert not kept.said
