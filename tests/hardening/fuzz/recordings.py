"""Recordings, bags, lists of points and tables of joints: half of them nearly good."""

from __future__ import annotations

import tempfile
from functools import cache
from pathlib import Path

import numpy as np

from tests.hardening.fuzz.nasty import CELLS, pick, spoilt

ROBOT = "ur10e"
_JOINTS = 6
_KEYS = (
    "robot", "flange", "chain", "title", "noise_mm", "noise_Nm", "resolution_deg", "inertials", "drive_gain_Nm_per_A",
    "payload_com_m", "compliance_rad_per_Nm", "joint_names", "map", "kind", "calibration", "inertial_prior",
)  # fmt: skip
_UNITS = {"q": ("rad", "deg", "m"), "tau": ("Nm",), "qd": ("rad_s", "deg_s"), "i": ("A",), "qc": ("rad",)}


def recording(rng: np.random.Generator) -> bytes:
    """A touch, tracker or motion recording in this program's own CSV, as it is or as a spreadsheet saved it."""
    kind = pick(rng, ("touch", "tracker", "motion"))
    names = [
        f"q{j}_{pick(rng, _UNITS['q']) if rng.random() < 0.02 else 'rad'}" for j in range(1, _JOINTS + 1)
    ]
    names += {"touch": ["target"], "tracker": ["x_mm", "y_mm", "z_mm"], "motion": []}[kind]
    if kind == "motion":
        names = [f"t_{pick(rng, ('s', 'ms', 'iso', 'ns'))}", *names]
        more = pick(rng, ("tau", "i", "qd", "qc"))
        names += [f"{more}{j}_{_UNITS[more][0]}" for j in range(1, _JOINTS + 1)]
    count = int(rng.integers(1, 90))
    table = rng.uniform(-1.5, 1.5, (count, len(names))).round(4).astype(str).tolist()
    if kind == "motion":
        for k, row in enumerate(table):
            row[0] = str(0.01 * k)
    for _ in range(int(rng.integers(0, 4))):
        pick(rng, table)[int(rng.integers(len(names)))] = pick(rng, CELLS)
    if rng.random() < 0.2:
        names[int(rng.integers(len(names)))] = pick(
            rng, ("q1_rad", "", "tau_Nm", "session", "pose", "qw", "q99_rad")
        )
    head = [f"# kind: {kind}", f"# robot: {ROBOT}"]
    head += [f"# {pick(rng, _KEYS)}: {pick(rng, CELLS)}" for _ in range(int(rng.integers(0, 3)))]
    mark = pick(rng, (",", ",", ";", "\t"))
    text = "\n".join([*head, mark.join(names), *map(mark.join, table)]) + "\n"
    if mark == ";" and rng.random() < 0.5:
        text = text.replace(".", ",")
    text = spoilt(rng, text, 2) if rng.random() < 0.4 else text
    return _coded(rng, text)


def rtde(rng: np.random.Generator) -> bytes:
    """A log of Universal Robots' real-time data exchange."""
    torque = pick(rng, ("actual_current", "actual_current_as_torque"))
    names = ["timestamp", *(f"{n}_{j}" for n in ("actual_q", torque) for j in range(6))]
    count = int(rng.integers(1, 150))
    t = 0.01 * np.arange(count)
    values = {name: np.sin(2.0 * t + k) * (1.0 if "q" in name else 30.0) for k, name in enumerate(names)}
    values["timestamp"] = t
    if rng.random() < 0.3:
        names += [pick(rng, (*names, "payload", "x"))]
        names = list(rng.permutation(names))
    mark = pick(rng, (" ", ",", ";", "\t"))
    columns = [values.get(str(name), t) for name in names]
    rows = [mark.join(f"{v:.4f}" for v in row) for row in zip(*columns, strict=True)]
    text = "\n".join([mark.join(names), *rows]) + "\n"
    return _coded(rng, spoilt(rng, text, 3) if rng.random() < 0.7 else text)


def point_list(rng: np.random.Generator) -> bytes:
    """What instruments export: names or none, inches, headers in two languages, matrices, ROS poses."""
    angle = np.tile(np.arange(0, 60, 10), 2)
    c, s, second = 900 * np.cos(np.radians(angle)), 900 * np.sin(np.radians(angle)), np.arange(12) >= 6
    x, y, z = (np.where(second, *pair).round(3) for pair in ((s, c), (0 * s + 10, s), (c, 0 * c + 300)))
    names = [f"A{2 if two else 1}_{turn}" for two, turn in zip(second, angle, strict=True)]
    rows = [f"{a} {b} {c}" for a, b, c in zip(x, y, z, strict=True)]
    semicolons, commas = ([r.replace(" ", sign) for r in rows] for sign in (";", ", "))
    matrices = [f"1 0 0 {a} 0 1 0 {b} 0 0 1 {c}" for a, b, c in map(str.split, rows)]
    poses = "position.x,position.y,position.z,orientation.x,orientation.y,orientation.z,orientation.w"
    lists = (
        ["Point ID;X [mm];Y [mm];Z [mm]", *(f"{n};{r}" for n, r in zip(names, semicolons, strict=True))],
        [
            "Punkt;X [mm];Y [mm];Z [mm]",
            *(f"{n};{r.replace('.', ',')}" for n, r in zip(names, semicolons, strict=True)),
        ],
        ["// Units: inches", *(f"coll, grp, {n}, {r}" for n, r in zip(names, commas, strict=True))],
        ["X [mm]; Y [mm]; Z [mm]", *semicolons],
        ["# unit: mm", *matrices],
        [poses, *(f"{r},0,0,0,1" for r in commas)],
    )
    text = "\n".join(pick(rng, lists)) + "\n"
    return _coded(rng, spoilt(rng, text, 3) if rng.random() < 0.7 else text)


def joint_table(rng: np.random.Generator) -> bytes:
    """Denavit-Hartenberg rows."""
    rows = [",".join(f"{v:.3f}" for v in rng.uniform(-300, 300, 4)) for _ in range(int(rng.integers(1, 9)))]
    head = pick(rng, ("", "# convention: standard\n", "# convention: modified\n", "# convention: [\n"))
    return spoilt(rng, head + "a_mm,alpha_deg,d_mm,theta_deg\n" + "\n".join(rows) + "\n", 3).encode(
        "utf-8", "replace"
    )


def calibration(rng: np.random.Generator) -> bytes:
    """Universal Robots' differences to the model's DH rows."""
    rows = {name: rng.normal(0, 1e-4, 6) for name in ("delta_theta", "delta_a", "delta_d", "delta_alpha")}
    lines = [f"{name} = [{', '.join(f'{v:.1e}' for v in row)}]" for name, row in rows.items()]
    return spoilt(rng, "[mounting]\n" + "\n".join(lines) + "\n", 3).encode("utf-8", "replace")


def bag(rng: np.random.Generator) -> bytes:
    """A bag with some bytes changed, cut out or doubled."""
    data = bytearray(pick(rng, _bags()))
    for _ in range(int(rng.integers(0, 6))):
        at = int(rng.integers(len(data)))
        how = int(rng.integers(4))
        if how == 0:
            data[at : at + 8] = rng.integers(0, 256, 8, dtype=np.uint8).tobytes()
        elif how == 1:
            data[at] = pick(rng, (0, 1, 127, 128, 255))
        elif how == 2:
            del data[at : at + int(rng.integers(1, 60))]
        else:
            data[at:at] = data[at : at + int(rng.integers(1, 60))]
    return bytes(data)


@cache
def _bags() -> tuple[bytes, ...]:
    from rosbags.rosbag1 import Writer as First
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    from app.kinematics import load_robot

    names = [joint.name for joint in load_robot(ROBOT).joints]
    out = []
    with tempfile.TemporaryDirectory() as folder:
        for store, kind in (
            (get_typestore(Stores.ROS2_HUMBLE), "2"),
            (get_typestore(Stores.ROS1_NOETIC), "1"),
        ):
            path = Path(folder) / f"bag{kind}"
            if kind == "2":
                writer = Writer(path, version=9, storage_plugin=StoragePlugin.MCAP)
            else:
                path = path.with_suffix(".bag")
                writer = First(path)
                writer.set_compression(First.CompressionFormat.BZ2)
            with writer:
                topic = writer.add_connection("/joint_states", "sensor_msgs/msg/JointState", typestore=store)
                for i in range(90):
                    stamp = store.types["builtin_interfaces/msg/Time"](sec=1, nanosec=i * 10_000_000)
                    more = {"seq": i} if kind == "1" else {}
                    head = store.types["std_msgs/msg/Header"](stamp=stamp, frame_id="", **more)
                    q = np.sin(0.1 * i + np.arange(6))
                    message = store.types["sensor_msgs/msg/JointState"](
                        header=head, name=names, position=q, velocity=q, effort=50.0 * q
                    )
                    encode = store.serialize_cdr if kind == "2" else store.serialize_ros1
                    writer.write(topic, 10**9 + i * 10**7, encode(message, "sensor_msgs/msg/JointState"))
            out.append(next(path.glob("*.mcap")).read_bytes() if path.is_dir() else path.read_bytes())
    return tuple(out)


def _coded(rng: np.random.Generator, text: str) -> bytes:
    if rng.random() < 0.05:
        return text.encode("utf-16", errors="replace")
    if rng.random() < 0.1:
        text = text.replace("\n", pick(rng, ("\r\n", "\r")))
    return text.encode("utf-8", errors="replace")
