"""Diagnoses made by hand, so that the words and pictures are tested without any engine."""

import numpy as np

from app.diagnosis.result import (
    Alternative,
    Diagnosis,
    Evidence,
    FamilyShare,
    Finding,
    Leftover,
    Noise,
    Parameter,
    Quality,
    Verdict,
)


def compliance():
    return Finding(
        effect="joint_compliance",
        where={"joint": 2, "driver": "gravity_torque"},
        parameters=(Parameter("compliance", 1.234e-5, 4.1e-7, "rad/Nm"),),
        visible=0.83,
        p_value=0.005,
        heldout_rms_without=0.842,
        heldout_rms_with=0.153,
        alternatives=(
            Alternative("gear_ratio", {"joint": 2, "driver": "own_angle"}, 3.12),
            Alternative("link_length", {"link": 3, "axis": "a"}, 7.9),
        ),
        sentence="Joint 2 bends under the weight it carries: 12 millionths of a radian for each newton-metre.",
        equation="Δq₂ = c · τ₂(q)",
    )


def static_case(verdict: Verdict = "named", rows=60, seed=3):
    """A tracker recording with a soft joint 2."""
    rng = np.random.default_rng(seed)
    q = rng.uniform(-1.5, 1.5, (rows, 6))
    points = np.stack([0.9 * np.cos(q[:, 0]), 0.9 * np.sin(q[:, 0]), 0.6 + 0.4 * np.sin(q[:, 1])], 1)
    torque = 160 * np.cos(q[:, 1])
    noise = rng.normal(0, 0.00015, (rows, 3))
    off = np.zeros((rows, 3))
    off[:, 2] = -1.2e-5 * torque
    off -= off.mean(0)
    kept = np.ones(rows, bool)
    kept[[4, 21]] = False
    noise[[4, 21]] += 0.004
    found = () if verdict in ("clean", "unexplained") else (compliance(),)
    return Diagnosis(
        file="cell_7.csv",
        kind="tracker",
        robot="tf6-850",
        samples=rows,
        verdict=verdict,
        noise=Noise(0.15, "mm", "stated"),
        before=Quality(0.798, 0.842, "mm"),
        after=Quality(0.147, 0.153, "mm"),
        findings=found,
        outliers=(9, 26),
        leftover=Leftover(
            0.43 if verdict in ("clean", "named") else 0.005,
            {"joint": 3, "driver": "own_angle"},
            0.0 if verdict in ("clean", "named") else 0.06,
        ),
        families=(
            (FamilyShare("elasticity", 0.94, 0.171, (0,)), FamilyShare("unnamed", 0.02, 0.153))
            if found
            else ()
        ),
        next_poses=((0.1, -0.9, 1.2, 0.0, 0.5, 0.0), (1.4, -0.2, 0.3, 0.7, -0.5, 1.0)),
        seconds=0.31,
        notes=("Rows 12 and 13 are the same to the last digit; one of them was used.",),
        evidence=Evidence(
            rows=np.arange(5, 5 + rows),
            measured=points + off + noise,
            before=off + noise,
            after=noise if found else off + noise,
            components=("x", "y", "z"),
            unit="m",
            q=q,
            drivers={
                "gravity torque of joint 2 [Nm]": torque,
                "angle of joint 2 [deg]": np.degrees(q[:, 1]),
                "angle of joint 3 [deg]": np.degrees(q[:, 2]),
                "time [min]": np.arange(rows) * 0.5,
            },
            kept=kept,
            points_predicted_before=points,
            points_predicted_after=points + (off if found else 0),
            points_measured=points + off + noise,
            flange_tool=np.array([0.0, 0.05, 0.12]),
            t=np.arange(rows) * 30.0,
        ),
    )


def motion_case(seconds=12.0, rate=100, seed=5):
    """A log in which joint 3 rubs and the arm is pushed once."""
    rng = np.random.default_rng(seed)
    t = np.arange(0, seconds, 1 / rate)
    m = len(t)
    phase = rng.uniform(0, 6, 6)
    speed = np.linspace(0.5, 1.2, 6)
    q = np.sin(t[:, None] * speed + phase)
    qd = speed * np.cos(t[:, None] * speed + phase)
    base = np.array([20, 60, 35, 6, 4, 1.5]) * np.cos(t[:, None] * 0.7 + phase)
    noise = rng.normal(0, np.array([0.8, 1.0, 0.6, 0.15, 0.12, 0.08]), (m, 6))
    rub, push = np.zeros((m, 6)), np.zeros((m, 6))
    rub[:, 2] = 6.0 * np.tanh(qd[:, 2] / 0.02)
    window = (t > 4.1) & (t < 4.9)
    push[window, 1], push[window, 2] = 14.0, 7.0
    return Diagnosis(
        file="log_a.csv",
        kind="motion",
        robot="tf6-850",
        samples=m,
        verdict="named",
        noise=Noise(0.55, "Nm", "residual"),
        before=Quality(2.9, 2.95, "Nm"),
        after=Quality(0.56, 0.57, "Nm"),
        findings=(
            Finding(
                "coulomb_friction",
                {"joint": 3, "driver": "speed"},
                (Parameter("level", 6.02, 0.05, "Nm"),),
                0.97,
                0.005,
                2.31,
                0.57,
                (Alternative("friction_asymmetry", {"joint": 3, "driver": "speed"}, 8.8),),
                "Joint 3 rubs with 6 Nm, whichever way it turns.",
                "τ₃ = F · sign(q̇₃)",
            ),
            Finding(
                "contact",
                {"from_s": 4.1, "to_s": 4.9},
                (Parameter("force", 31.0, 1.4, "N"),),
                0.9,
                0.005,
                1.02,
                0.57,
                (),
                "The arm touched something between 4.1 s and 4.9 s.",
                "τ = Jᵀ F",
            ),
        ),
        outliers=(),
        leftover=Leftover(0.31, {}),
        next_poses=(),
        families=(FamilyShare("friction", 0.73, 1.02, (0,)), FamilyShare("events", 0.12, 0.57, (1,))),
        seconds=0.42,
        notes=("Speed by a zero-phase Butterworth filter, order 4, 12 Hz.",),
        evidence=Evidence(
            rows=np.arange(4, 4 + m),
            measured=base + rub + push + noise,
            before=rub + push + noise,
            after=noise,
            components=tuple(f"joint {j}" for j in range(1, 7)),
            unit="Nm",
            q=q,
            drivers={f"speed of joint {j + 1} [deg/s]": np.degrees(qd[:, j]) for j in range(6)},
            kept=np.ones(m, bool),
            t=t,
            parts={"friction": rub, "events": push},
        ),
    )
