"""`teachframe sessions`: list, export, take in."""

import json

import pytest

from app.session import Store
from app.session.actions import Record
from tests.cli.running import assert_one_line, teachframe


@pytest.fixture
def taught(tmp_path):
    session = Store(tmp_path).create(robot="ur10e")
    session.do(Record("touch1"))
    session.close()
    return session


def test_the_list_names_every_session(taught, tmp_path):
    said = teachframe("sessions", "--data", tmp_path)
    assert said.code == 0 and taught.name[:12] in said.out and "ur10e" in said.out
    said = teachframe("sessions", "--data", tmp_path, "--json")
    (row,) = [json.loads(line) for line in said.out.splitlines()]
    assert row["name"] == taught.name and row["actions"] == 2


def test_what_is_exported_is_taken_in_elsewhere_and_replayed(taught, tmp_path):
    file = tmp_path / "session.jsonl"
    assert teachframe("sessions", "--data", tmp_path, "--export", taught.name[:8], "--out", file).code == 0
    other = tmp_path / "other"
    said = teachframe("sessions", "--data", other, "--take", file)
    assert said.code == 0
    name = said.out.strip()
    assert Store(other).recorded(name).entries == taught.entries
    replayed = [teachframe("replay", name, "--data", other), teachframe("replay", file)]
    assert replayed[0].code == 0 and replayed[0].out == replayed[1].out


def test_another_database_is_used_by_every_command(taught, tmp_path):
    url = f"sqlite:///{tmp_path / 'here.db'}"
    name = Store(tmp_path / "x", url).create(robot="iiwa7").name
    assert name[:12] in teachframe("sessions", "--database", url).out
    assert teachframe("replay", name, "--database", url).code == 0


def test_bad_input_is_one_line(taught, tmp_path):
    assert_one_line(teachframe("sessions", "--data", tmp_path, "--export", "zzz"), "zzz", taught.name)
    assert_one_line(teachframe("sessions", "--data", tmp_path, "--out", "x"), "--export")
    assert_one_line(teachframe("sessions", "--database", "nonsense"), "nonsense", "sqlite:///")
    rubbish = tmp_path / "rubbish.jsonl"
    rubbish.write_bytes(b"\x00\x01")
    assert_one_line(teachframe("sessions", "--data", tmp_path, "--take", rubbish), "rubbish.jsonl", "row 1")
