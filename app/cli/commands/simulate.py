"""Makes a recording with known effects in it; the truth goes to OUT.truth.json only."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import tyro

if TYPE_CHECKING:
    from app.diagnosis.model import SavedModel
    from app.proof.generator.simulate import Part


@dataclass
class Command:
    """Makes a recording with known effects in it; the truth goes to OUT.truth.json only.

    Example: teachframe simulate --robot ur5e --kind tracker --effect joint_compliance:joint=2 out.csv
    """

    out: Annotated[Path, tyro.conf.Positional]
    """The CSV to write."""

    robot: str
    """A robot's name (see `teachframe robots`) or the path of a URDF."""

    kind: Literal["touch", "tracker", "motion"]
    """What is recorded: touches of points, tracked points, or joint torques over time."""

    flange: Annotated[str | None, tyro.conf.arg(metavar="LINK")] = None
    """The link tools are bolted to; without it tool0, flange, an ee-link or the last one: the output names it."""

    chain: Annotated[str | None, tyro.conf.arg(metavar="BASE..TIP")] = None
    """The arm within a description of several: its first and its last link."""

    effect: Annotated[list[str], tyro.conf.UseAppendAction, tyro.conf.arg(metavar="NAME[:joint=2,...]")] = (
        field(default_factory=list)
    )
    """What is wrong, once an effect: NAME, or NAME:joint=2,size=0.1 (also source_joint=, driver=, link=, axis=,
    from_row=, from_s=, to_s=, and each parameter by name). What is left open is drawn."""

    model: Annotated[Path | None, tyro.conf.arg(metavar="IN.json")] = None
    """A model saved by `diagnose --save-model`: everything in it is in the cell, before any --effect."""

    seed: int = 0
    """Same seed, same file."""

    samples: int | None = None
    """Rows; 60 touches or tracked points, 4000 of motion unless said otherwise."""

    noise_mm: float = 0.15
    """One-sigma noise of each axis (touch, tracker)."""

    noise_kind: Literal["gaussian", "coloured", "heavy", "laplace", "mixed"] = "gaussian"
    """How the noise is distributed."""

    outliers: float = 0.0
    """Share of rows that went wrong."""

    targets: int = 5
    """Touched points (touch)."""

    known_targets: bool = False
    """Write the targets' coordinates into the file (touch)."""

    reflectors: Literal[1, 2, 3] = 1
    """Tracked points on the tool (tracker)."""

    sessions: int = 1
    """Set-ups, each with its own instrument frame and tool (tracker)."""

    orientation: bool = False
    """The tracker measures orientation too."""

    wire: bool = False
    """Only the length of a draw-wire is measured (tracker)."""

    torque_sensors: bool = False
    """Record joint torques too (tracker)."""

    repeats: int = 0
    """Rows that repeat the pose before them (tracker)."""

    loads_kg: tuple[float, ...] = ()
    """Declared loads, taken in turns."""

    clutter_mm: float = 0.0
    """One-sigma error of every length of the arm as built, with twists and zeros to match."""

    rate_hz: float = 125.0
    """Samples a second (motion)."""

    noise_share: float = 0.003
    """One-sigma noise of each torque, as a share of the joint's rated torque (motion)."""

    currents: bool = False
    """Record motor currents and drive gains instead of torques (motion)."""

    friction: float = 0.0
    """Dry and viscous friction in every joint, as a share of its rated torque (motion)."""

    def run(self) -> int:
        from app.diagnosis.model_checks import applying

        model = self._check()

        def say(text: str) -> None:
            print(text, file=sys.stderr)

        with applying(model, self.model):
            (self._motion if self.kind == "motion" else self._static)(say)
        say(self._arm())
        return 0

    def _static(self, say) -> None:
        from app.errors import InputError
        from app.proof.generator.static.making import Plan
        from app.units import from_mm

        if self.noise_mm <= 0 or not 0 <= self.outliers <= 0.5 or self.sessions < 1 or self.targets < 1:
            raise InputError(
                "a noise, share or count that cannot be",
                expected="--noise-mm above 0, --outliers 0 to 0.5, --sessions and --targets from 1",
            )
        from app.proof.generator.simulate import simulate_static

        plan = Plan(
            kind=self.kind,
            samples=self.samples if self.samples is not None else 60,
            noise=from_mm(self.noise_mm),
            noise_kind=self.noise_kind,
            outliers=self.outliers,
            sessions=self.sessions if self.kind == "tracker" else 1,
            reflectors=self.reflectors if self.kind == "tracker" else 1,
            orientation=self.orientation and self.kind == "tracker",
            wire=self.wire and self.kind == "tracker",
            targets=self.targets,
            known_targets=self.known_targets,
            repeats=self.repeats if self.kind == "tracker" else 0,
            loads_kg=self.loads_kg,
            torque_sensors=self.torque_sensors and self.kind == "tracker",
        )
        simulate_static(
            self._place(),
            plan,
            self.effect,
            self.seed,
            self.out,
            held=self._held(plan.samples, say),
            clutter=from_mm(self.clutter_mm),
            part=self._part(),
            say=say,
        )

    def _check(self) -> SavedModel | None:
        """The model given; numbers that no recording can be made with are refused before anything is made."""
        import math

        from app.diagnosis.model import load_model
        from app.errors import InputError
        from app.files import check_writable

        check_writable(self.out)
        model = None if self.model is None else load_model(self.model)
        for name, value, least, most in (
            ("--seed", self.seed, 0, 2**63 - 1),
            ("--samples", self.samples if self.samples is not None else 60, 1, 1_000_000),
            ("--repeats", self.repeats, 0, 1_000_000),
            ("--targets", self.targets, 1, 100_000),
            ("--sessions", self.sessions, 1, 10_000),
            ("--noise-mm", self.noise_mm, 0.0, 1e4),
            ("--clutter-mm", self.clutter_mm, 0.0, 1e3),
            ("--outliers", self.outliers, 0.0, 0.5),
            ("--rate-hz", self.rate_hz, 1.0, 1e6),
            ("--noise-share", self.noise_share, 0.0, 1e3),
            ("--friction", self.friction, 0.0, 1e3),
            *(("--loads-kg", load, 0.0, 1e4) for load in self.loads_kg),
        ):
            if not (math.isfinite(value) and least <= value <= most):
                raise InputError(f"found {value}", column=name, expected=f"{least} to {most}")
        return model

    def _motion(self, say) -> None:
        from app.errors import InputError
        from app.proof.generator.motion.making import MotionPlan
        from app.proof.generator.motion.simulate import simulate_motion

        if self.rate_hz <= 0 or self.noise_share <= 0 or self.friction < 0:
            raise InputError(
                "a rate, noise or friction that cannot be",
                expected="--rate-hz and --noise-share above 0, --friction from 0",
            )
        plan = MotionPlan(
            samples=self.samples if self.samples is not None else 4000,
            rate=self.rate_hz,
            noise=self.noise_share,
            noise_kind=self.noise_kind,
            currents=self.currents,
            friction=self.friction,
        )
        held = self._held(plan.samples, say, seconds=plan.samples / plan.rate)
        simulate_motion(
            self._place(), plan, self.effect, self.seed, self.out, held=held, part=self._part(), say=say
        )

    def _held(self, samples: int, say, *, seconds: float = 0.0) -> tuple:
        """The saved model's effects, where one is given."""
        if self.model is None:
            return ()
        from app.diagnosis.model import load_model
        from app.proof.held import terms_of

        terms, left_out = terms_of(
            load_model(self.model),
            self.kind,
            self._address(),
            samples=samples,
            seconds=seconds,
            file=self.model,
        )
        for line in left_out:
            say(line)
        return terms

    def _address(self) -> str:
        from app.kinematics.description.address import address_of

        return str(address_of(self.robot, self.flange, self.chain))

    def _place(self) -> str:
        """The robot's name or its file alone."""
        from app.kinematics.description.address import parse_address

        return parse_address(self._address()).place

    def _arm(self) -> str:
        """The arm that was taken, in a line."""
        from app.kinematics import load_robot

        arm = load_robot(self._address())
        return f"{arm.name}: {arm.joint_count} joints from {arm.base} to its flange {arm.flange}"

    def _part(self) -> Part | None:
        """The arm within a description of one's own; the shipped ones are arms as they stand."""
        from app.kinematics import load_robot, robot_names
        from app.kinematics.description.address import parse_address
        from app.proof.generator.simulate import Part

        arm = load_robot(self._address())
        if self._address() in robot_names():
            return None
        address = parse_address(self._address())
        chosen = {} if address.flange is None else {"flange": arm.flange}
        if address.chain is not None:
            chosen["chain"] = f"{arm.base}..{arm.flange}"
        return Part(arm.urdf, arm.flange, chosen)
