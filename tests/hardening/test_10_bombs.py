"""Small files that stand for much: refused in one line, within seconds of the processor and a bounded memory."""

import bz2
import io
import json
import os
import struct
import zipfile

import h5py
import polars as pl
import pytest

from tests.hardening.small import MOST_MEMORY, MOST_SECONDS, ran, refused


def made(content):
    """What is large is made by the test that needs it, not by every process that collects the tests."""
    return content() if callable(content) else content


POINTS = "# kind: points\n# angles: ZYX\n{}\nrole,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg\ntouch,1,2,3,4,5,6\n"
ALIASES = "&a [1,1,1,1,1,1,1,1,1]"
HEADERS = {
    "aliases": f"# title: [{ALIASES}, " + ", ".join(["*a"] * 100) + "]",
    "itself": "# known_tool_mm: &a [*a]",
    "digits": "# noise_mm: " + "9" * 60_000,
    "hexadecimal": "# noise_mm: 0x" + "f" * 60_000,
    "base sixty": "# noise_mm: " + "59:" * 3000 + "59",
    "brackets": "# title: " + "[" * 9000,
    "tables": "# title: " + "{a: " * 2000,
    "a tag": '# title: !!python/object/apply:os.system ["id"]',
    "a set": "# title: !!set {a, b}",
    "a merge": "# title: {<<: {a: 1}}",
    "half a letter": '# title: "\\ud800"',
}


@pytest.mark.parametrize("name", HEADERS)
def test_a_header(name, tmp_path):
    (tmp_path / "p.csv").write_text(POINTS.format(HEADERS[name]))
    assert "p.csv" in refused("solve", "p.csv", folder=tmp_path)


MODEL = {"format": "teachframe.model/1", "kind": "static", "robot": "ur10e", "effects": []}
EFFECT = {"effect": "joint_zero", "where": {"joint": 1}, "parameters": {"offset": 1e-3}}
MODELS = {
    "nested 900 deep": json.dumps({**MODEL, "nuisance": None}).replace("null", "[" * 900 + "]" * 900),
    "nested 200,000 deep": "[" * 200_000,
    "tables in tables": '{"a":' * 200_000,
    "5,000 effects": json.dumps({**MODEL, "effects": [EFFECT] * 5000}),
    "ten million numbers": lambda: "[" + "1," * 10_000_000 + "1]",
    "one text": lambda: '"' + "a" * 20_000_000 + '"',
    "one number": "1" * 1_000_000,
    "5,000 parameters": json.dumps(
        {**MODEL, "effects": [{**EFFECT, "parameters": {f"p{k}": 1.0 for k in range(5000)}}]}
    ),
}


@pytest.mark.parametrize("name", MODELS)
def test_a_model(name, tmp_path):
    (tmp_path / "m.json").write_text(made(MODELS[name]))
    assert "m.json" in refused("export-model", "m.json", "o.xml", "--to", "mjcf", folder=tmp_path)


HEAD = {"session": "0" * 32, "created": 1.0, "format": "teachframe.session/1"}
ROBOT = {"do": "choose_robot", "robot": "ur10e"}


def journal(*actions):
    entries = [{"n": n, "t": 1.0, "action": a} for n, a in enumerate((ROBOT, *actions), 1)]
    return "\n".join(map(json.dumps, (HEAD, *entries))) + "\n"


JOURNALS = {
    "a billion touches": journal({"do": "choose_mode", "mode": "touch", "touches": 10**9}),
    "a step of brackets": journal({"do": "record", "step": "[" * 100_000, "q": [0.0] * 6}),
    "joints without end": journal({"do": "record", "step": "touch1", "q": [0.0] * 100_000}),
    "lines and nothing else": lambda: "\n" * 40_000_000,
    "nested": json.dumps(HEAD)[:-1] + ', "x": ' + "[" * 100_000 + "\n",
    "zeros": "\0" * 1_000_000,
}


@pytest.mark.parametrize("name", JOURNALS)
def test_a_session(name, tmp_path):
    (tmp_path / "s.jsonl").write_text(made(JOURNALS[name]))
    assert "s.jsonl" in refused("replay", "s.jsonl", folder=tmp_path)


@pytest.mark.parametrize("actions", [[{"do": "undo"}] * 20_000, [{"do": "undo"}, {"do": "redo"}] * 10_000])
def test_twenty_thousand_undos_are_answered(actions, tmp_path):
    (tmp_path / "s.jsonl").write_text(journal({"do": "choose_mode", "mode": "touch", "touches": 4}, *actions))
    found = ran("replay", "s.jsonl", folder=tmp_path)
    assert found.code in (0, 2) and found.seconds < MOST_SECONDS and found.memory < MOST_MEMORY, found


def packed(**members):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as file:
        for name, content in members.items():
            file.writestr(name.replace("__", "."), content)
    return out.getvalue()


XACRO = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="a">{}</robot>'
ROBOTS = {
    "bomb.zip": lambda: packed(a__urdf="<robot/>", b__stl=b"\0" * 400_000_000),
    "many.zip": lambda: packed(**{f"f{k}": "" for k in range(20_000)}),
    "itself.xacro": XACRO.format('<xacro:include filename="itself.xacro"/>'),
    "macro.xacro": XACRO.format('<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>'),
    "power.xacro": XACRO.format('<xacro:property name="p" value="${9**9**9}"/>${p}'),
    "text.xacro": XACRO.format("${'a'*10**10}"),
    "doubling.xacro": XACRO.format(
        '<xacro:property name="p0" value="aaaaaaaaaa"/>'
        + "".join(f'<xacro:property name="p{k}" value="${{p{k - 1}}}${{p{k - 1}}}"/>' for k in range(1, 40))
        + '<link name="${p39}"/>'
    ),
    "list.xacro": XACRO.format("${[1]*10**10}"),
    "chain.urdf": lambda: (
        "<robot name='a'><link name='l0'/>"
        + "".join(
            f"<link name='l{k}'/><joint name='j{k}' type='fixed'><parent link='l{k - 1}'/><child link='l{k}'/></joint>"
            for k in range(1, 2001)
        )
        + "</robot>"
    ),
    "star.urdf": lambda: (
        "<robot name='a'><link name='b'/>"
        + "".join(
            f"<link name='l{k}'/><joint name='j{k}' type='fixed'><parent link='b'/><child link='l{k}'/></joint>"
            for k in range(60_000)
        )
        + "</robot>"
    ),
    "entities.urdf": "<!DOCTYPE r [<!ENTITY a 'bbbbbbbbbb'><!ENTITY c '&a;&a;&a;&a;'>]><robot>&c;</robot>",
    "rows.csv": "a_mm,alpha_deg,d_mm,theta_deg\n" + "1,2,3,4\n" * 100_000,
}


@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot(name, tmp_path):
    content = made(ROBOTS[name])
    (tmp_path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    assert name in refused("simulate", "--robot", name, "--kind", "touch", "o.csv", folder=tmp_path)


def mcap(compression, chunk, claimed):
    """The smallest MCAP with one compressed chunk."""

    def text(value):
        return struct.pack("<I", len(value)) + value.encode()

    def record(kind, body):
        return struct.pack("<BQ", kind, len(body)) + body

    magic = b"\x89MCAP0\r\n"
    body = struct.pack("<QQQI", 0, 1, claimed, 0) + text(compression) + struct.pack("<Q", len(chunk)) + chunk
    footer = record(2, struct.pack("<QQI", 0, 0, 0))
    return (
        magic
        + record(1, text("ros2") + text("x"))
        + record(6, body)
        + record(15, struct.pack("<I", 0))
        + footer
        + magic
    )


def test_a_bag_of_one_piece_that_unpacks_to_gigabytes(tmp_path):
    import zstandard

    chunk = zstandard.ZstdCompressor().compress(b"\0" * 700_000_000)
    (tmp_path / "b.mcap").write_bytes(mcap("zstd", chunk, 700_000_000))
    assert "b.mcap" in refused("diagnose", "b.mcap", "--robot", "ur5", folder=tmp_path)


def test_a_ros_1_bag_of_such_a_piece(tmp_path):
    packed_ = bz2.compress(b"\0" * 300_000_000)
    header = b"".join(
        struct.pack("<I", len(field)) + field
        for field in (b"op=\x05", b"compression=bz2", b"size=" + struct.pack("<I", 300_000_000))
    )
    bag = (
        b"#ROSBAG V2.0\n"
        + struct.pack("<I", len(header))
        + header
        + struct.pack("<I", len(packed_))
        + packed_
    )
    (tmp_path / "b.bag").write_bytes(bag)
    assert "b.bag" in refused("diagnose", "b.bag", "--robot", "ur5", folder=tmp_path)


@pytest.mark.parametrize("name", ["fifo", "zero", "loop", "folder"])
@pytest.mark.parametrize(
    "argv",
    [
        ("solve", "NAME"),
        ("base", "NAME"),
        ("replay", "NAME"),
        ("export", "NAME"),
        ("diagnose", "NAME", "--robot", "ur5"),
        ("diagnose", "log.csv", "--robot", "NAME"),
        ("diagnose", "log.csv", "--model", "NAME"),
        ("diagnose", "log.csv", "--reference", "NAME"),
        ("diagnose", "log.csv", "--joints", "NAME"),
        ("diagnose", "log.csv", "--calibration", "NAME"),
        ("export-model", "NAME", "o.urdf", "--to", "urdf"),
        ("simulate", "--robot", "ur5", "--kind", "touch", "--samples", "8", "NAME"),
    ],
    ids=" ".join,
)
def test_what_is_no_regular_file(argv, name, tmp_path):
    os.mkfifo(tmp_path / "fifo")
    (tmp_path / "zero").symlink_to("/dev/zero")
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "folder").mkdir()
    (tmp_path / "log.csv").write_text("# kind: touch\n# robot: ur5\nq1_rad,target\n0,a\n")
    refused(*(name if word == "NAME" else word for word in argv), folder=tmp_path)


def test_parquet_of_zeros_that_stand_for_a_gigabyte(tmp_path):
    frame = pl.DataFrame({f"q{j}": pl.zeros(20_000_000, eager=True) for j in range(1, 7)})
    frame.write_parquet(tmp_path / "l.parquet")
    said = refused("diagnose", "l.parquet", "--robot", "ur10e", folder=tmp_path)
    assert "960 MB of numbers are packed in it" in said


def test_hdf5_of_nothing_that_stands_for_a_gigabyte(tmp_path):
    with h5py.File(tmp_path / "l.h5", "w") as file:
        for name in ("q", "tau"):
            file.create_dataset(name, (10_000_000, 6), "f8", chunks=(1000, 6))
    assert "MB of numbers are packed in it" in refused(
        "diagnose", "l.h5", "--robot", "ur10e", folder=tmp_path
    )


def test_bytes_of_a_name_that_stand_for_no_letters(tmp_path):
    assert "not UTF-8" in refused("solve", os.fsdecode(b"\xff.csv"), folder=tmp_path)
