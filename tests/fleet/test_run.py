"""A row a file, none lost, none doubled, nothing done twice."""

import shutil

import pytest

from app.fleet import work as working
from app.fleet.finding import recordings
from app.fleet.ledger import Ledger, read_rows
from app.fleet.run import run
from app.fleet.work import Settings
from tests.fleet.making import Here, recording


@pytest.fixture(scope="module")
def shop(tmp_path_factory):
    """Three recordings, one of them twice, and one that is none."""
    root = tmp_path_factory.mktemp("shop")
    for number, name in enumerate(("a/1.csv", "a/2.csv", "b/1.csv")):
        recording(root / name, number)
    shutil.copy(root / "a/1.csv", root / "b/copy.csv")
    (root / "b/broken.csv").write_text("nothing\n", encoding="utf-8")
    return root


def gone_through(root, out, settings=None, after=None, fresh=False):
    settings = settings or Settings()
    workers = Here(settings, after)
    ledger = Ledger(out, fresh=fresh)
    try:
        counts = run(recordings(root), root, ledger, settings, workers, lambda _: None)
        ledger.write()
    finally:
        ledger.close()
    return counts, workers.worked


def test_a_row_a_file_in_their_order_and_the_same_content_is_worked_on_once(shop, tmp_path):
    out = tmp_path / "r.parquet"
    counts, worked = gone_through(shop, out)
    rows = list(read_rows(out))
    assert [r.file for r in rows] == [str(p) for p in recordings(shop)]
    assert len(rows) == 5 and len(worked) == 4 and counts.broken == 1
    copy, first = (next(r for r in rows if r.file.endswith(name)) for name in ("copy.csv", "a/1.csv"))
    assert (copy.diagnosis, copy.arm, first.arm) == (first.diagnosis, "b", "a")
    broken = next(r for r in rows if r.error)
    assert broken.reason == "input" and broken.file in broken.error and not broken.diagnosis
    assert not out.with_name("r.parquet.part").exists()


def test_a_second_run_does_nothing_and_a_changed_file_alone_is_done_anew(shop, tmp_path):
    root = shutil.copytree(shop, tmp_path / "shop")
    out = tmp_path / "r.parquet"
    gone_through(root, out)
    assert gone_through(root, out)[1] == []
    recording(root / "a/2.csv", 9)
    counts, worked = gone_through(root, out)
    assert worked == [str(root / "a/2.csv")] and counts.kept == 4
    assert [r.run for r in read_rows(out)] == [1, 2, 1, 1, 1]  # a run that did nothing is none


def test_another_seed_or_version_is_other_work(shop, tmp_path, monkeypatch):
    out = tmp_path / "r.parquet"
    gone_through(shop, out)
    assert len(gone_through(shop, out, Settings(seed=1))[1]) == 4
    for module in ("keys", "work"):
        monkeypatch.setattr(f"app.fleet.{module}.__version__", "9.9")
    assert len(gone_through(shop, out, Settings(seed=1))[1]) == 4
    assert len(gone_through(shop, out, Settings(seed=1), fresh=True)[1]) == 4


def test_a_run_that_is_stopped_goes_on_where_it_was(shop, tmp_path):
    out = tmp_path / "r.parquet"
    with pytest.raises(KeyboardInterrupt):
        gone_through(shop, out, after=2)
    assert not out.exists() and out.with_name("r.parquet.part").exists()
    counts, worked = gone_through(shop, out)
    assert (counts.kept, len(worked)) == (3, 2)  # two were done, and one of them lies there twice
    assert len(list(read_rows(out))) == 5


def test_a_file_over_its_time_is_a_row_that_more_time_does_again(shop, tmp_path):
    out = tmp_path / "r.parquet"
    counts, _ = gone_through(shop, out, Settings(limit=1e-6))
    late = [r for r in read_rows(out) if r.reason == "time"]
    assert len(late) == 4 and counts.broken == 5 and "longer than 1e-06 s" in late[0].error
    assert gone_through(shop, out, Settings(limit=1e-6))[1] == []
    counts, worked = gone_through(shop, out, Settings(limit=600))
    assert len(worked) == 3 and counts.broken == 1


def test_the_robot_beside_a_recording_is_part_of_its_content(tmp_path):
    from app.fleet.keys import content_key
    from app.kinematics import load_robot

    urdf = tmp_path / "arm.urdf"
    shutil.copy(load_robot("ur5").path, urdf)
    path = tmp_path / "r.csv"
    path.write_text("# kind: tracker\n# robot: arm.urdf\nq1_rad\n0\n", encoding="utf-8")
    before = content_key(path)
    assert content_key(path) == before
    urdf.write_text(urdf.read_text(encoding="utf-8") + "<!-- -->", encoding="utf-8")
    assert content_key(path) != before


def test_a_fault_of_the_program_is_a_row_too(shop, tmp_path, monkeypatch):
    def fails(*_args, **_named):
        raise ZeroDivisionError("by zero")

    monkeypatch.setattr(working, "diagnose_file", fails)
    gone_through(shop, tmp_path / "r.parquet")
    said = {r.reason for r in read_rows(tmp_path / "r.parquet")}
    assert said == {"fault"}
