"""teachframe fleet as a person calls it."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from app.fleet.ledger import Ledger, read_rows
from tests.cli.running import assert_one_line, teachframe
from tests.fleet.making import recording


@pytest.fixture(scope="module")
def shop(tmp_path_factory):
    root = tmp_path_factory.mktemp("shop")
    for number in range(4):
        recording(root / f"SN-{number % 2}" / f"2026-0{number + 1}-01.csv", number)
    return root


def test_all_cores_give_rows_summary_and_page(shop, tmp_path):
    out, page = tmp_path / "r.parquet", tmp_path / "r.html"
    said = teachframe("fleet", shop, "--out", out, "--processes", "1", "--report", page)
    assert said.code == 0, said.err
    assert "4 recordings of 2 arms" in said.out and "SN-0, SN-1" in said.out
    assert "4 done now" in said.err and "SN-0, SN-1" in page.read_text(encoding="utf-8")
    assert {row.arm for row in read_rows(out)} == {"SN-0", "SN-1"}
    again = teachframe("fleet", shop, "--out", out, "--resume")
    assert "0 done now, 4 known" in again.err and again.code == 0


def test_a_process_that_dies_ends_one_file_only(shop, tmp_path):
    """A file's reader that ends its process, as the system does where memory is short."""
    (tmp_path / "sitecustomize.py").write_text(
        "import os, sys\n"
        "if any('multiprocessing' in a for a in sys.argv + sys.orig_argv):\n"
        "    import app.fleet.work as w\n"
        "    inner = w.diagnose_file\n"
        "    w.diagnose_file = lambda p, **k: os._exit(9) if '2026-02' in str(p) else inner(p, **k)\n",
        encoding="utf-8",
    )
    out = tmp_path / "r.parquet"
    env = {**os.environ, "PYTHONPATH": f"{tmp_path}{os.pathsep}{Path.cwd()}"}
    argv = [sys.executable, "-m", "app", "fleet", str(shop), "--out", str(out), "--processes", "2"]
    done = subprocess.run(argv, env=env, capture_output=True, text=True, check=False, timeout=100)
    assert done.returncode == 0, done.stderr
    rows = list(read_rows(out))
    assert [(r.reason, "died" in r.error) for r in rows if r.error] == [("died", True)]
    assert len(rows) == 4


def test_an_interrupt_keeps_what_is_done_and_says_how_to_go_on(shop, tmp_path):
    out = tmp_path / "r.parquet"
    argv = [sys.executable, "-m", "app", "fleet", str(shop), "--out", str(out), "--processes", "1"]
    running = subprocess.Popen(argv, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
    part = tmp_path / "r.parquet.part"
    end = time.monotonic() + 60
    while not part.exists() and time.monotonic() < end:
        time.sleep(0.05)
    time.sleep(0.3)
    running.send_signal(signal.SIGINT)
    _, said = running.communicate(timeout=30)
    assert running.returncode == 130 and "the same command goes on" in said and "Traceback" not in said


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--out", "r.csv"], ["r.csv", ".parquet"]),
        (["--out", "r.parquet", "--limit-s", "0"], ["--limit-s"]),
        (["--out", "r.parquet", "--processes", "0"], ["--processes"]),
        (["--out", "nowhere/r.parquet"], ["no such folder"]),
        (["--out", "r.parquet", "--model", "none.json"], ["none.json"]),
        (["--out", "r.parquet", "--robot", "nobody"], ["nobody"]),
    ],
)
def test_bad_input_is_one_line(shop, tmp_path, monkeypatch, more, words):
    monkeypatch.chdir(tmp_path)
    assert_one_line(teachframe("fleet", shop, *more), *words)


def test_a_place_without_recordings_or_results_of_another_kind_are_one_line(tmp_path):
    assert_one_line(teachframe("fleet", tmp_path, "--out", tmp_path / "r.parquet"), "no recordings here")
    assert_one_line(
        teachframe("fleet", tmp_path / "x", "--out", tmp_path / "r.parquet"), "no such folder or list"
    )
    other = tmp_path / "other.parquet"
    other.write_bytes(b"PAR1 not one")
    path = recording(tmp_path / "a.csv")
    assert_one_line(teachframe("fleet", path.parent, "--out", other), "other.parquet", "teachframe fleet")
    assert other.read_bytes() == b"PAR1 not one"


def test_two_runs_on_one_results_file_are_told_apart(tmp_path, monkeypatch):
    monkeypatch.setattr("app.fleet.ledger._BUSY", 0.1)
    path = recording(tmp_path / "a.csv")
    first = Ledger(tmp_path / "r.parquet")
    first.give([str(path)])
    assert_one_line(
        teachframe("fleet", tmp_path, "--out", tmp_path / "r.parquet"), "another run writes there"
    )
    first.close()
