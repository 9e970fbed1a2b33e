"""MATLAB, HDF5 and Parquet: arrays under names of their own become a recording by a small mapping."""

from __future__ import annotations

import json
import struct
import zlib

import h5py
import numpy as np
import polars as pl
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.io import savemat

from app.errors import InputError
from app.recordings import read_table
from app.recordings.arm import read_with_arm
from app.recordings.options import ReadOptions, parse_mapping
from tests.kinematics.description.making import line, written

ROWS = 50
T = np.arange(ROWS) * 0.01
Q = np.linspace([0.1, 0.2], [0.5, -0.4], ROWS)
TAU = 10 * Q + 1


def options(text=None, **more):
    return ReadOptions(mapping=parse_mapping(text), **more)


def mat(path, **held):
    savemat(path, held, do_compression=True)
    return path


def hdf5(path, attributes=None, **held):
    with h5py.File(path, "w") as file:
        for name, values in held.items():
            file[name.replace("__", "/")] = values
        file.attrs.update(attributes or {})
    return path


def same(table):
    assert table.kind == "motion"
    assert np.allclose(table.numbers(["q1", "q2"]), Q) and np.allclose(table.numbers(["tau1", "tau2"]), TAU)
    assert np.allclose(table.number("t"), T)


def test_usual_names_need_no_mapping(tmp_path):
    same(read_table(mat(tmp_path / "a.mat", q=Q, tau=TAU, time=T)))
    same(read_table(hdf5(tmp_path / "a.h5", log__positions=Q, log__efforts=TAU, log__timestamp=T)))
    frame = pl.DataFrame({"q": Q.tolist(), "torque": TAU.tolist(), "t": T})
    frame.write_parquet(tmp_path / "a.parquet")
    same(read_table(tmp_path / "a.parquet"))


def test_a_mapping_names_arrays_and_their_units(tmp_path):
    path = mat(
        tmp_path / "a.mat", data={"joints": np.degrees(Q), "m": TAU, "clock": T * 1e3}, other=np.zeros(3)
    )
    same(read_table(path, options("q=data.joints:deg,tau=data.m,t=data.clock:ms")))
    path = hdf5(tmp_path / "a.h5", arm__a=np.degrees(Q).T, arm__b=TAU.T, arm__c=(T * 1e9).astype(np.int64))
    same(read_table(path, options("q=arm/a:deg,tau=arm/b,t=arm/c:ns")))


def test_the_mapping_may_stand_in_the_file_itself(tmp_path):
    same(read_table(mat(tmp_path / "a.mat", x1=Q, x2=TAU, x3=T, map="q=x1,tau=x2,t=x3")))
    same(read_table(hdf5(tmp_path / "a.h5", {"map": "q=x1,tau=x2,t=x3"}, x1=Q, x2=TAU, x3=T)))


def test_what_was_taken_is_said(tmp_path):
    table = read_table(mat(tmp_path / "a.mat", q=Q, tau=TAU, time=T))
    assert any("q = q" in note and "t = time" in note for note in table.notes)


@pytest.mark.parametrize(
    "text, problem",
    [
        (None, "which of these are the joints' angles"),
        ("q=nothing", "unknown array 'nothing'"),
        ("q=a", "no time"),
        ("q=a,t=b,tau=c", "array c is 3x1"),
        ("q=a:Nm,t=b", "says Nm for q1"),
        ("q=a,t=b:furlong", "says furlong"),
        ("q", "QUANTITY=NAME"),
    ],
)
def test_a_mapping_that_does_not_fit_is_answered_in_one_line(tmp_path, text, problem):
    path = mat(tmp_path / "a.mat", a=Q, b=T, c=np.zeros(3))
    with pytest.raises(InputError) as caught:
        read_table(path, options(text))
    assert problem in str(caught.value) and "\n" not in str(caught.value)


def lerobot(folder, names=("j2.pos", "gripper.pos", "j1.pos")):
    (folder / "meta").mkdir(parents=True)
    feature = {"dtype": "float32", "shape": [3], "names": list(names)}
    info = {"features": {"observation.state": feature, "action": feature}}
    (folder / "meta" / "info.json").write_text(json.dumps(info))
    (folder / "data" / "chunk-000").mkdir(parents=True)
    state = np.degrees(np.column_stack([Q[:, 1], np.zeros(ROWS), Q[:, 0]]))
    for episode in range(2):
        frame = pl.DataFrame(
            {
                "observation.state": state.tolist(),
                "action": state.tolist(),
                "timestamp": T,
                "episode_index": episode,
            }
        )
        frame.write_parquet(folder / "data" / "chunk-000" / f"episode_{episode:06d}.parquet")
    return folder


def test_a_lerobot_data_set_is_read_by_the_names_of_its_features(tmp_path):
    robot = written(tmp_path, line(2))
    table, _ = read_with_arm(
        lerobot(tmp_path / "set"), str(robot), options("q=observation.state:deg,qc=action:deg")
    )
    assert len(table) == 2 * ROWS and table.names[:2] == ("q1_deg", "q2_deg") and table.has("qc1", "qc2")
    assert np.allclose(table.numbers(["q1", "q2"])[:ROWS], Q)
    t = table.number("t")
    assert np.all(np.diff(t) > 0) and t[ROWS] - t[ROWS - 1] == pytest.approx(1.0)


def test_a_small_file_that_stands_for_gigabytes_is_refused(tmp_path):
    packer, packed = zlib.compressobj(9), []
    packed += [packer.compress(bytes(10_000_000)) for _ in range(60)]
    data = b"".join([*packed, packer.flush()])
    head = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM"
    (tmp_path / "bomb.mat").write_bytes(head + struct.pack("<II", 15, len(data)) + data)
    with pytest.raises(InputError, match="unpacks to over"):
        read_table(tmp_path / "bomb.mat")
    with h5py.File(tmp_path / "bomb.h5", "w") as file:
        file.create_dataset("q", (300_000_000, 6), "f8", chunks=(1000, 6), compression="gzip")
    with pytest.raises(InputError, match="too large"):
        read_table(tmp_path / "bomb.h5")


def test_data_that_lies_in_another_file_is_not_read(tmp_path):
    (tmp_path / "secret").write_bytes(np.arange(100.0).tobytes())
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file.create_dataset("q", (50, 2), "f8", external=[(str(tmp_path / "secret"), 0, 800)])
        file["other"] = h5py.ExternalLink(str(tmp_path / "b.h5"), "/q")
        file["t"] = T
    with pytest.raises(InputError, match="which of these"):
        read_table(tmp_path / "a.h5")


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    kind=st.sampled_from(["mat", "h5", "parquet"]),
    at=st.integers(0, 6000),
    noise=st.binary(min_size=1, max_size=40),
    cut=st.booleans(),
)
def test_damaged_files_are_one_line_or_a_table(tmp_path, kind, at, noise, cut):
    path = tmp_path / f"a.{kind}"
    if kind == "mat":
        mat(path, q=Q, tau=TAU, t=T)
    elif kind == "h5":
        hdf5(path, q=Q, tau=TAU, t=T)
    else:
        pl.DataFrame({"q": Q.tolist(), "t": T}).write_parquet(path)
    data = path.read_bytes()
    at = at % len(data)
    path.write_bytes(data[:at] + noise + (b"" if cut else data[at + len(noise) :]))
    try:
        read_table(path).tolerant("q1")
    except InputError as error:
        assert "\n" not in str(error)
