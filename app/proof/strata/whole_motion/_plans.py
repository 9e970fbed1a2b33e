"""What logs of real arms look like, and what stands out in them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app import catalog
from app.proof.generator.dynamics import turned_gravity
from app.proof.generator.effects.term import Request
from app.proof.generator.motion.cell import OUTSIDE
from app.proof.generator.motion.making import MotionPlan
from app.proof.generator.motion.members import draw_drives
from app.proof.generator.motion.whole import WholeLog

#: Half of the arms have one thing that explains most.
DOMINANT = 0.5
SHARE = (0.6, 0.95)
MASSES = (0.05, 0.20)  # share a link
SHARPNESS = (1.0e-3, 3.0e-2)  # rad/s: below, dry friction fades; drawn a joint
LINKED = 0.25  # of the loads
#: What can stand out.
KEYS = (
    "payload", "payload_change", "gravity_direction", "torque_constant", "delay", "link_inertia", "contact",
    "coulomb_friction", "viscous_friction", "friction_asymmetry", "rotor_inertia", "joint_spring", "torque_ripple",
    "joint_coupling", "warmup_friction", "stribeck_friction",
)  # fmt: skip


def draw_log(rng: np.random.Generator) -> MotionPlan:
    """A log with noise that remembers more often than not, and spikes."""
    return MotionPlan(
        samples=int(rng.choice([2500, 3500, 5000])),
        rate=float(rng.choice([100.0, 125.0, 250.0])),
        noise=float(np.exp(rng.uniform(np.log(0.001), np.log(0.006)))),
        noise_kind=str(rng.choice(["gaussian", "coloured", "heavy", "laplace"], p=[0.2, 0.4, 0.2, 0.2])),
        stated=bool(rng.random() < 0.4),
        speeds=bool(rng.random() < 0.7),
        currents=bool(rng.random() < 0.3),
        repeats=bool(rng.random() < 0.3),
        jitter=float(rng.choice([0.0, 0.0, 0.2])),
        strength=float(rng.uniform(8.0, 25.0)),
        sharpness=SHARPNESS,
        spikes=float(rng.choice([0.0, 0.0, 0.001, 0.004])),
    )


def second_log(plan: MotionPlan) -> MotionPlan:
    """The log to be predicted: no spike, so that an error is the model's."""
    return replace(plan, spikes=0.0, stale=0.0, gaps=0, noise_kind="gaussian", samples=2500, repeats=False)


def draw_dominant(rng: np.random.Generator) -> Request:
    """One thing that explains most."""
    key = KEYS[int(rng.integers(len(KEYS)))]
    if key == "torque_constant" and rng.random() < 0.6:
        scale = float(rng.uniform(0.06, 0.35) * rng.choice([-1.0, 1.0]))
        return Request(key, {"common": True}, {"scale": scale})
    if key == "gravity_direction":
        return Request(key, {}, _leaning(rng))
    if key == "payload" and rng.random() < 0.25:  # a hand that the description has and the arm has not
        hand = {"mass": -float(rng.uniform(0.4, 1.5)), "com_x": 0.0, "com_y": 0.0}
        return Request(key, {}, {**hand, "com_z": float(rng.uniform(0.03, 0.12))})
    return draw_load(rng) if key == "payload" else Request(key)


def draw_load(rng: np.random.Generator) -> Request:
    """A load: on the flange, or in a quarter of the cases on one of the links before it."""
    return Request("payload", {"link": int(rng.integers(2, 6))} if rng.random() < LINKED else {})


def _leaning(rng: np.random.Generator) -> dict[str, float]:
    """Gravity in the base of an arm that leans by some degrees, or hangs on a wall or from a ceiling."""
    way, lot = rng.uniform(0, 2 * np.pi), rng.random()
    angle = rng.uniform(0.05, 0.35) if lot < 0.6 else (0.5 * np.pi if lot < 0.8 else np.pi)
    gravity = turned_gravity(angle * np.array([np.cos(way), np.sin(way), 0.0]))
    return {name: float(g) for name, g in zip(("gx", "gy", "gz"), gravity, strict=True)}


def draw_unknown(rng: np.random.Generator) -> Request:
    """A law that no library holds."""
    keys = list(catalog.members(OUTSIDE, "EFFECT"))
    return Request(keys[int(rng.integers(len(keys)))])


def draw_arm(rng: np.random.Generator, plan: MotionPlan, dominant: Request | None) -> WholeLog:
    """An arm and its two logs."""
    return WholeLog(
        plan=plan,
        second=second_log(plan),
        drives=draw_drives(rng),
        masses=float(rng.uniform(*MASSES)),
        dominant=dominant,
        share=float(rng.uniform(*SHARE)) if dominant else 0.0,
    )
