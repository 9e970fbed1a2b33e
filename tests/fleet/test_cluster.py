"""The same work on a Dask cluster, whoever dies there."""

import threading

import pytest

from app.cli import run as command
from app.fleet.ledger import read_rows
from benchmarks._cluster import Cluster
from tests.cli.running import assert_one_line, teachframe
from tests.fleet.making import recording

pytest.importorskip("distributed")
COUNT = 16


@pytest.fixture(scope="module")
def shop(tmp_path_factory):
    root = tmp_path_factory.mktemp("shop")
    for number in range(COUNT):
        recording(root / f"{number:02d}.csv", number)
    return root


def test_a_worker_and_the_scheduler_are_killed_and_no_row_is_lost_or_doubled(
    shop, tmp_path, monkeypatch, capfd
):
    monkeypatch.setenv("PYTHONWARNINGS", "ignore")
    cluster = Cluster(2, tmp_path)
    out = tmp_path / "r.parquet"
    codes = []
    kept = []
    from app.fleet.ledger import Ledger

    add = Ledger.add

    def counted(self, row):
        add(self, row)
        kept.append(row.file)
        if len(kept) in (4, 9):
            cluster.kill("worker 0" if len(kept) == 4 else "scheduler")

    monkeypatch.setattr(Ledger, "add", counted)
    try:
        argv = ["fleet", str(shop), "--out", str(out), "--scheduler", cluster.address]
        running = threading.Thread(target=lambda: codes.append(command(argv)))
        running.start()
        running.join(timeout=200)
    finally:
        cluster.stop()
    assert codes == [0], capfd.readouterr().err
    rows = [row.file for row in read_rows(out)]
    assert rows == sorted(str(path) for path in shop.glob("*.csv"))
    assert sorted(kept) == rows
    assert not any(row.error for row in read_rows(out))


def test_a_scheduler_that_does_not_answer_is_one_line(shop, tmp_path, monkeypatch):
    monkeypatch.setattr("app.fleet.cluster._ANSWER", 1.0)
    for address in ("tcp://127.0.0.1:1", "tcp://nowhere.invalid:8786"):
        said = teachframe("fleet", shop, "--out", tmp_path / "r.parquet", "--scheduler", address)
        assert_one_line(said, "--scheduler", "does not answer")


@pytest.mark.parametrize(
    "address",
    ["", "nonsense", "nonsense://x", "tcp://127.0.0.1", "http://127.0.0.1:80", "tcp://[::1]:99999", "a b:1"],
)
def test_what_is_no_address_is_one_line_before_a_client_is_made(shop, tmp_path, monkeypatch, address):
    """Dask made half a client of it, whose end came twenty seconds later, as a trace."""
    monkeypatch.setattr("distributed.Client", None)
    said = teachframe("fleet", shop, "--out", tmp_path / "r.parquet", "--scheduler", address)
    assert_one_line(said, "--scheduler", "is no address", "tcp://HOST:8786")
