"""A few hundred hostile requests at a real server: none let in, nobody's page lost. More: tests/hardening/hostile."""

import pytest

from app.people import People
from app.session import Store
from tests.hardening.hostile import working
from tests.hardening.hostile.asking import PASSWORD, Asking, log_in
from tests.hardening.hostile.attacks import Known, attacks, private
from tests.hardening.hostile.running import run
from tests.shell.started import Started


@pytest.fixture
def quick(monkeypatch):
    """The trainees ask less often: what is tried is not the machine."""
    monkeypatch.setattr(working, "PING", 0.3)


def test_nobody_is_let_in_and_nobody_loses_his_page(tmp_path, quick):
    told = run(300, 2, tmp_path, quiet=0.5)
    assert told["requests"] == 300 and len(told["by kind"]) > 9
    assert told["let in by kind"] == {} and told["let in"] == 0
    assert told["server alive"] and told["pages lost"] == 0 and told["answers"] > 0


def test_what_looks_at_the_answers_sees_who_is_let_in(tmp_path):
    """The same requests with a cookie that counts: were the doors open, the run would say so."""
    people = People(Store(tmp_path).database)
    people.add("ada", "Ada", "administrator", PASSWORD)
    with Started(tmp_path) as served:
        good = log_in(served.port, "ada", PASSWORD)
        known = Known(served.port, good, good, "0" * 32, "0" * 32, "0" * 32, "x")
        kinds = attacks(known)
        ask = Asking(served.port)
        assert ask("GET", "/", cookie=good)[0] == 200
        count = len(private(known))
        forged = kinds["forged, stolen, ended cookies"][0]
        assert any(forged(ask, 6 * count + k) for k in range(count)), "the seventh cookie is one that counts"
        assert not any(forged(ask, k) for k in range(count))
        assert kinds["sockets without a log-in"][0](ask, 6) and not kinds["sockets without a log-in"][0](
            ask, 0
        )
