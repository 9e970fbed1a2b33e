"""One generator a kind of file: `rng -> bytes`, half of them nearly good, so that they get past the first check."""

from __future__ import annotations

import json

import numpy as np

from app.calibration.exchange import ToolFrame, exchange_format, formats
from app.geometry import Pose, rot_y
from tests.calibration.exchange.test_every_format import MORE_TEXTS, TEXTS
from tests.hardening.fuzz.nasty import CELLS, pick, spoilt, spoilt_value

_FRAME = ToolFrame("torch", Pose.of(rot_y(0.4), np.array([0.1, 0.0, 0.3])), 2.0, (0.0, 0.0, 0.1))
_TEXTS = [
    *TEXTS.values(),
    *(t for _, t in MORE_TEXTS.values()),
    *(exchange_format(k).write(_FRAME) for k in formats()),
]


def controller(rng: np.random.Generator) -> bytes:
    text = spoilt(rng, pick(rng, _TEXTS))
    if rng.random() < 0.1:
        text += spoilt(rng, pick(rng, _TEXTS))
    return text.encode("utf-8", errors="replace")


def points(rng: np.random.Generator) -> bytes:
    """Points files: headers, columns and cells by their grammar."""
    keys = [
        "# kind: points",
        "# angles: " + pick(rng, ("ZYX", "ZYZ", "XYZ", "rotvec", "quaternion", "ABC", "")),
    ]
    if rng.random() < 0.2:
        keys.append(
            f"# {pick(rng, ('robot', 'title', 'note', 'known_tool_mm', 'resolution_deg', ''))}: {pick(rng, CELLS)}"
        )
    joints = rng.random() < 0.2
    names = (
        [f"q{j}_deg" for j in range(1, 7)] if joints else ["x_mm", "y_mm", "z_mm", "a_deg", "b_deg", "c_deg"]
    )
    if joints:
        keys.append("# robot: ur10e")
    if rng.random() < 0.1:
        names[int(rng.integers(6))] = pick(rng, ("x_m", "x_in", "q9_deg", "", "role", "x_mm", "qw"))
    roles = ["touch"] * int(rng.integers(1, 6)) + ["touch+origin", "x", "z"][: int(rng.integers(0, 4))]
    rows = [[role, *(f"{v:.3f}" for v in rng.uniform(-90, 90, len(names)))] for role in roles]
    for _ in range(int(rng.integers(0, 3)) if rng.random() < 0.6 else 0):
        row = pick(rng, rows)
        row[int(rng.integers(len(row)))] = pick(rng, CELLS)
    lines = [*keys, ",".join(["role", *names]), *(",".join(row) for row in rows)]
    text = "\n".join(lines) + "\n"
    return (spoilt(rng, text, 2) if rng.random() < 0.3 else text).encode("utf-8", errors="replace")


def arcs(rng: np.random.Generator) -> bytes:
    """Arcs of axis 1 and 2 with some cells spoilt."""
    rows = []
    for axis in (1, 2):
        for angle in np.linspace(0.0, rng.uniform(0.1, 3.0), int(rng.integers(1, 8))):
            c, s = 900 * np.cos(angle), 900 * np.sin(angle)
            xyz = (c, s, 300.0) if axis == 1 else (s, 10.0, c)
            rows.append([str(axis), *(f"{v:.3f}" for v in xyz)])
    for _ in range(int(rng.integers(0, 4)) if rng.random() < 0.7 else 0):
        row = pick(rng, rows)
        row[int(rng.integers(4))] = pick(rng, CELLS)
    head = ["# kind: arcs"]
    if rng.random() < 0.3:
        head.append(
            f"# {pick(rng, ('robot', 'axis1_sense', 'towards_workspace_mm', 'noise_mm'))}: {pick(rng, CELLS)}"
        )
    return ("\n".join([*head, "axis,x_mm,y_mm,z_mm", *map(",".join, rows)]) + "\n").encode(
        "utf-8", errors="replace"
    )


_PARAMETERS = {
    "joint_zero": ("joint", {"offset": 0.01}),
    "joint_compliance": ("joint", {"compliance": 1e-6}),
    "link_length": ("link", {"offset": 0.001}),
    "link_inertia": ("link", {"mass": 0.4, "mx": 0.01, "izz": 0.02}),
    "payload": ("body", {"mass": 2.0, "com_x": 0.0, "com_y": 0.0, "com_z": 0.1}),
    "viscous_friction": ("joint", {"viscous": 3.0}),
    "coulomb_friction": ("joint", {"coulomb": 3.0}),
    "rotor_inertia": ("joint", {"inertia": 0.4}),
    "joint_spring": ("joint", {"stiffness": 3.0, "offset": 1.0}),
    "gravity_direction": ("body", {"gx": 0.1, "gy": 0.0, "gz": -9.8}),
    "delay": ("driver", {"delay": 0.004}),
    "torque_constant": ("joint", {"scale": 0.1}),
    "contact": ("from_s", {"fx": 1.0}),
    "telepathy": ("joint", {}),
}


def model(rng: np.random.Generator) -> bytes:
    effects = []
    for _ in range(int(rng.integers(0, 5))):
        key = pick(rng, tuple(_PARAMETERS))
        place, parameters = _PARAMETERS[key]
        where = {place: int(rng.integers(0, 9)) if place in ("joint", "link") else "tool"}
        if key == "link_length":
            where["axis"] = pick(rng, ("a", "d", "alpha", "q"))
        effects.append({"effect": key, "where": where, "parameters": parameters})
    out = {
        "format": "teachframe.model/1", "kind": pick(rng, ("motion", "static")), "robot": "ur10e", "effects": effects,
        "nuisance": pick(rng, ({}, {"inertial": [0.1] * 60}, {"inertial": []})), "source": "log.csv",
    }  # fmt: skip
    text = json.dumps(spoilt_value(rng, out))
    return (spoilt(rng, text, 1) if rng.random() < 0.1 else text).encode("utf-8", errors="replace")


_POSE = [1.0, 0.1, 0.9, 0.3, 0.2, 0.1]
_ACTIONS = (
    {"do": "choose_robot", "robot": "ur10e"},
    {"do": "choose_mode", "mode": "touch", "touches": 4},
    {"do": "choose_mode", "mode": "direct"},
    {"do": "choose_method", "method": "robust"},
    {"do": "move", "q": [0.1] * 6, "path": [[0.1] * 6]},
    {"do": "user_frame", "place": [0.1, 0.2, 0.3], "quaternion": [1.0, 0.0, 0.0, 0.0]},
    {"do": "record", "step": "touch1"},
    {"do": "record", "step": "touch2", "q": [0.3] * 6},
    {"do": "re_record", "step": "touch1", "q": [0.5] * 6},
    {"do": "delete", "step": "touch1"},
    {"do": "comment", "step": "touch1", "text": "<b>x</b>"},
    {"do": "enter", "position": [0.1, 0.0, 0.3], "angles": [0.1, 0.2, 0.3], "convention": "ZYX"},
    {"do": "calculate"},
    {"do": "accept", "name": "tool"},
    {"do": "cancel"},
    {"do": "undo"},
    {"do": "redo"},
    {"do": "begin", "exercise": "first_tool", "seed": 3, "at": 1.0, "robot": "ur10e", "mode": "touch", "touches": 4},
    {"do": "open_cell", "first": "ur10e", "second": "ur5", "seed": 3},
    {"do": "tracked", "point": [1.0, 2.0, 0.3], "angle": 0.1, "name": "n", "sigma": 1e-5},
    {"do": "tracker_next"},
    {"do": "tracker_undo"},
    {"do": "close_cell"},
    {"do": "finish", "answer": "nothing", "number": 0},
    {
        "do": "load_points", "source": "s", "title": "t", "mode": "touch", "method": "joint", "roles": ["touch"] * 4,
        "rows": [1, 2, 3, 4], "columns": ["x", "y", "z", "a", "b", "c"], "steps": [0.0] * 6, "angles": "ZYX",
        "values": [_POSE, [1.0, 0.2, 0.8, -0.4, 0.5, 0.9], [1.1, 0.1, 0.9, 0.8, -0.3, 0.2], [0.9, 0, 1, 0.1, 0.7, 0]],
    },
    {"do": "use_model", "model": {
        "kind": "static", "robot": "ur10e",
        "effects": [{"effect": "joint_compliance", "where": {"joint": 2}, "parameters": {"compliance": 1e-6}}],
    }},
)  # fmt: skip


def journal(rng: np.random.Generator) -> bytes:
    lines = [{"session": "0" * 32, "created": 1.0, "format": "teachframe.session/1"}]
    lines += [
        {"n": n, "t": 1.0, "action": pick(rng, _ACTIONS) if n > 1 else _ACTIONS[0]}
        for n in range(1, int(rng.integers(2, 10)))
    ]
    chance = 0.0 if rng.random() < 0.2 else 0.03
    text = "\n".join(json.dumps(spoilt_value(rng, line, chance)) for line in lines) + "\n"
    return (spoilt(rng, text, 1) if rng.random() < 0.1 else text).encode("utf-8", errors="replace")


def urdf(rng: np.random.Generator) -> bytes:
    """A chain of links with some attributes spoilt."""

    def number() -> str:
        return pick(rng, CELLS) if rng.random() < 0.02 else f"{rng.uniform(0.05, 0.6):.3f}"

    count = int(rng.integers(1, 8))
    parts = ['<link name="l0"/>']
    for k in range(1, count + 1):
        name = pick(rng, ("universe", "l0", "")) if rng.random() < 0.02 else f"l{k}"
        kind = (
            pick(rng, ("fixed", "continuous", "prismatic", "floating", ""))
            if rng.random() < 0.1
            else "revolute"
        )
        axis = (
            pick(rng, ("0 0 1", "0 1 0", "1 0 0"))
            if rng.random() > 0.03
            else pick(rng, ("0 0 0", "nan 0 1", "1 1", ""))
        )
        shape = f'<collision><geometry><box size="{number()} {number()} {number()}"/></geometry></collision>'
        parts.append(
            f'<link name="{name}"><inertial><origin xyz="0 0 {number()}"/><mass value="{number()}"/>'
            f'<inertia ixx="{number()}" iyy="{number()}" izz="{number()}" ixy="0" ixz="0" iyz="0"/></inertial>'
            f"{shape if rng.random() < 0.3 else ''}</link>"
            f'<joint name="j{k}" type="{kind}"><parent link="l{k - 1}"/><child link="l{k}"/>'
            f'<origin xyz="0 0 {number()}" rpy="{number()} 0 0"/><axis xyz="{axis}"/>'
            f'<limit lower="-{number()}" upper="{number()}" effort="10" velocity="1"/></joint>'
        )
    text = f'<?xml version="1.0"?><robot name="r">{"".join(parts)}</robot>'
    return (spoilt(rng, text, 2) if rng.random() < 0.4 else text).encode("utf-8", errors="replace")
