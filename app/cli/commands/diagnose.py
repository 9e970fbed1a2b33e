"""Finds where a recording and the robot's description differ, says what was left out, and models it."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import tyro

from app.cli.arguments import ReadingArguments, RobotArguments
from app.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from app.diagnosis.batch import Outcome
    from app.diagnosis.model import SavedModel
    from app.kinematics import RobotModel


@dataclass
class Command:
    """Finds where a recording and the robot's description differ, says what was left out, and models it.

    Reads recordings of kind touch, tracker and motion. Several files are worked on side by side; one that
    cannot be read gives its line on stderr and the others still come out.
    """

    files: Annotated[tuple[Path, ...], tyro.conf.Positional, tyro.conf.arg(metavar="FILE...")]
    """Recordings."""

    arm: tyro.conf.OmitArgPrefixes[RobotArguments] = field(default_factory=RobotArguments)
    """The robot."""

    reading: tyro.conf.OmitArgPrefixes[ReadingArguments] = field(default_factory=ReadingArguments)
    """How to read files that leave something open."""

    reference: Annotated[Path | None, tyro.conf.arg(metavar="FILE")] = None
    """A motion recording of the same arm in a known good state: what changed since?"""

    together: Annotated[bool, tyro.conf.FlagCreatePairsOff] = False
    """Take several touch or tracker recordings of one arm as one: what they share is learnt, each keeps its set-up."""

    json: Annotated[bool, tyro.conf.FlagCreatePairsOff] = False
    """One JSON object a file, one a line, in the order of the files."""

    report: Annotated[Path | None, tyro.conf.arg(metavar="OUT.html")] = None
    """Write a page with pictures: one file, nothing loaded from outside, ready to print."""

    language: Literal["en", "zh"] = "en"
    """Of the report; JSON and the text on the terminal stay English."""

    save_model: Annotated[Path | None, tyro.conf.arg(metavar="OUT.json")] = None
    """Write what was found as a model that the simulation, the pendant and --model load."""

    model: Annotated[Path | None, tyro.conf.arg(metavar="IN.json")] = None
    """Take a saved model as part of the robot: how well does it do on this recording, and what is left beyond it?"""

    save_urdf: Annotated[Path | None, tyro.conf.arg(metavar="OUT.urdf")] = None
    """Write the robot's description with those findings in it that a URDF can hold."""

    seed: Annotated[int, tyro.conf.arg(metavar="N")] = 0
    """Seed of the null distribution; the same seed gives the same answer."""

    def run(self) -> int:
        from app.cli.progress import shown_progress
        from app.diagnosis.model import load_model

        self._check()
        model = load_model(self.model) if self.model else None
        code, kept = 0, []
        with shown_progress(len(self.files)) as progress:
            for outcome in self._outcomes(model, progress):
                if outcome.diagnosis is None:
                    progress.line(f"teachframe diagnose: {outcome.error}")
                    code = 1 if outcome.fault or code == 1 else 2
                    continue
                progress.pause()
                self._print(outcome, first=not kept)
                kept.append(outcome.diagnosis)
        if kept:
            self._write(kept)
        return code

    def _check(self) -> None:
        if not self.files:
            raise InputError("no file given", expected="teachframe diagnose FILE...")
        if self.together and self.reference is not None:
            raise InputError("--together with --reference", expected="one of the two")
        if len(self.files) > 1 and not self.together:
            for option, value in (("--save-model", self.save_model), ("--save-urdf", self.save_urdf)):
                if value is not None:
                    raise InputError(
                        f"{option} with {len(self.files)} recordings", expected="one recording, or --together"
                    )
        for out in (self.report, self.save_model, self.save_urdf):
            if out is not None and not out.parent.is_dir():
                raise InputError("there is no such folder", file=out.parent, expected="a folder to write to")

    def _outcomes(self, model: SavedModel | None, progress) -> Iterator[Outcome]:
        """One file in this process, with its progress; several in their own, side by side."""
        from app.diagnosis.batch import Outcome, diagnose_many
        from app.diagnosis.dispatch import diagnose_file, diagnose_together

        if self.together and len(self.files) > 1:
            found = diagnose_together(
                self.files,
                robot=self.arm.address,
                model=model,
                progress=progress.update,
                seed=self.seed,
                options=self.reading.options,
            )
            yield Outcome(str(self.files[0]), found)
            return
        if len(self.files) == 1:
            found = diagnose_file(
                self.files[0],
                robot=self.arm.address,
                reference=self.reference,
                model=model,
                progress=progress.update,
                seed=self.seed,
                options=self.reading.options,
            )
            yield Outcome(str(self.files[0]), found)
            return
        outcomes = diagnose_many(
            self.files,
            robot=self.arm.address,
            reference=self.reference,
            model=model,
            evidence=self.report is not None,
            seed=self.seed,
            options=self.reading.options,
        )
        for done, outcome in enumerate(outcomes, 1):
            yield outcome
            progress.update(done / len(self.files), f"{done} of {len(self.files)} recordings")

    def _print(self, outcome: Outcome, *, first: bool) -> None:
        diagnosis = outcome.diagnosis
        assert diagnosis is not None
        if self.json:
            import msgspec

            told = {**diagnosis.to_json(), "flange": self._robot(outcome.file).flange}
            sys.stdout.write(msgspec.json.encode(told).decode() + "\n")
        else:
            from app.diagnosis.report import as_text

            arm = self._robot(outcome.file)
            slides = tuple(joint.prismatic for joint in arm.joints)
            sys.stdout.write(
                ("" if first else "\n" + "─" * 100 + "\n\n")
                + as_text(diagnosis, prismatic=slides, flange=arm.flange)
            )
        sys.stdout.flush()

    def _robot(self, file: str) -> RobotModel:
        from app.kinematics import load_robot
        from app.recordings import read_table
        from app.recordings.arm import robot_for

        if self.arm.robot is not None:
            return load_robot(str(self.arm.address))
        return robot_for(read_table(file, self.reading.options), self.arm.address)

    def _sources(self, kept: list) -> list[str]:
        """The file of each diagnosis; of several taken together the first."""
        return [str(self.files[0])] if self.together else [d.file for d in kept]

    def _write(self, kept: list) -> None:
        """The files asked for, each named on stderr."""
        if self.report is not None:
            from app.diagnosis.report import write_report

            robots = [self._robot(f) for f in self._sources(kept)]
            write_report(
                self.report,
                kept,
                robots,
                command=_command_line(),
                seed=self.seed,
                language=self.language,
            )
            print(f"report: {self.report}", file=sys.stderr)
        if self.save_model is None and self.save_urdf is None:
            return
        from app.diagnosis.model import model_of, save_model

        model = model_of(kept[0])
        if self.save_model is not None:
            save_model(model, self.save_model)
            print(f"model: {self.save_model}", file=sys.stderr)
        if self.save_urdf is not None:
            from app.diagnosis.corrected import save_corrected_urdf

            for line in save_corrected_urdf(self._robot(self._sources(kept)[0]), model, self.save_urdf):
                print(line, file=sys.stderr)
            print(f"description: {self.save_urdf}", file=sys.stderr)


def _command_line() -> str:
    """The command as it was typed, for the page's last line."""
    import shlex

    return "teachframe " + shlex.join(sys.argv[1:])
