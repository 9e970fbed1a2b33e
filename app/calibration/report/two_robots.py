"""Where the second robot stands for the first, on one sheet: what was found, how well, and what it rests on."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from markupsafe import Markup, escape

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.frame import in_parent
from app.calibration.base.relation import Relation
from app.calibration.base.result import BaseCalibration
from app.calibration.base.wording import TEXTS
from app.calibration.report.cell_from_above import cell_from_above
from app.calibration.report.pictures import arc_picture
from app.calibration.wording import phrase
from app.estimation import HALF
from app.geometry import Pose, convention
from app.phrases import FALLBACK
from app.templating import templates
from app.units import deg, mm

_ANGLES = convention("ZYX")


def two_robots_report(
    robots: Sequence[str],
    bases: Sequence[BaseCalibration],
    relation: Relation | None,
    *,
    made: str = "",
    language: str = FALLBACK,
    missed: tuple[float, float] | None = None,
) -> str:
    """A sheet of what was found; nothing of a cell's hidden truth is in it. Every text in it is escaped.

    Args:
        robots: their titles, in order.
        bases: one a robot.
        relation: of the two, where it was found.
        made: date and time as text; empty leaves a line to fill in.
        language: of the sheet.
        missed: [m] how far two tools sent to one point missed each other, and what was predicted (95%), where that
            was tried.
    """
    return _Sheet(robots, bases, relation, language).page(made, missed)


class _Sheet:
    def __init__(
        self,
        robots: Sequence[str],
        bases: Sequence[BaseCalibration],
        relation: Relation | None,
        language: str,
    ):
        self._robots, self._bases, self._relation, self._language = robots, bases, relation, language

    def _t(self, key: str, **fields: object) -> str:
        return TEXTS.text(f"sheet.{key}", self._language, **fields)

    def _of_all(self, key: str) -> str:
        """What stands on every sheet."""
        return phrase(f"sheet.{key}").text(self._language)

    def _drawn(self, key: str, **fields: object) -> str:
        """A text for a picture, which is markup already."""
        return str(escape(self._t(key, **fields)))

    def page(self, made: str, missed: tuple[float, float] | None) -> str:
        """The whole document."""
        t, relation = self._t, self._relation
        found = relation is not None and relation.T_base1_base2 is not None
        colour, reason = self._light()
        return (
            templates(__file__)
            .get_template("two_robots.html")
            .render(
                t=t,
                of_all=self._of_all,
                language=self._language,
                title=t("title"),
                head=[" + ".join(self._robots), *([made] if made else [])],
                colour=colour,
                colour_said=phrase("sheet.light", colour=phrase(f"light.{colour}")).text(self._language),
                reason=reason,
                value_head=("", t("value"), "95% ±"),
                relation=self._relation_rows() if found and relation else (),
                picture=Markup(cell_from_above(self._bases, relation, self._drawn))
                if found and relation
                else "",
                meeting=self._meeting(missed) if found else "",
                robots=[self._robot(k, base) for k, base in enumerate(self._bases)],
                arc_head=[
                    t(key) for key in ("axis", "points", "arc", "radius", "rms", "largest", "tilt", "centre")
                ],
                remarks=self._remarks(),
                blanks=(t("tracker"), self._of_all("temperature"), t("reflector")),
                signatures=(
                    (self._of_all("date"), made),
                    (self._of_all("operator"), ""),
                    (self._of_all("checked"), ""),
                ),
            )
        )

    def _light(self) -> tuple[str, str]:
        """Colour and sentence."""
        relation = self._relation
        if relation is None or relation.T_base1_base2 is None:
            return "red", self._t("none")
        remarked = relation.warnings or any(base.warnings for base in self._bases)
        return "yellow" if remarked else "green", self._t("known", miss=mm(relation.region_meeting))

    def _relation_rows(self) -> list[tuple[str, ...]]:
        relation = self._relation
        assert relation is not None and relation.T_base1_base2 is not None
        return self._pose_rows(relation.T_base1_base2, relation.covariance)

    def _pose_rows(self, pose: Pose, covariance: np.ndarray) -> list[tuple[str, ...]]:
        """Position and angles, each with its 95% half width along, and about, the axes they are counted by."""
        half = HALF * np.sqrt(np.diag(in_parent(pose, covariance)))
        angles = deg(np.asarray(_ANGLES.from_rotation(pose.rotation)))
        rows = [
            (f"{axis} [mm]", f"{value:.3f}", f"{width:.3f}")
            for axis, value, width in zip("XYZ", mm(pose.position), mm(half[:3]), strict=True)
        ]
        # A turns about Z, B about Y, C about X: the half widths stand in that order.
        rows += [
            (f"{name} [°]", f"{value:.4f}", f"{width:.4f}")
            for name, value, width in zip("ABC", angles, deg(half[5:2:-1]), strict=True)
        ]
        return rows

    def _meeting(self, missed: tuple[float, float] | None) -> str:
        assert self._relation is not None
        x, y, z = mm(self._relation.meeting)
        said = self._t("meeting", x=x, y=y, z=z, miss=mm(self._relation.region_meeting))
        if missed is not None:
            said += " " + self._t("met", miss=mm(missed[0]), predicted=mm(missed[1]))
        return said

    def _robot(self, number: int, base: BaseCalibration) -> dict[str, object]:
        t = self._t
        fields = {
            "offset": mm(base.offset),
            "offset_half": HALF * mm(base.offset_sigma),
            "angle": deg(base.angle),
            "angle_half": HALF * deg(base.angle_sigma),
        }
        axes = t("apart", **fields)
        if base.maker is not None:
            axes += " " + t(
                "described", offset=mm(base.maker.offset_nominal), angle=deg(base.maker.angle_nominal)
            )
        drawn = [
            arc_picture(_errors(a), a.used, self._drawn("picture_arc", axis=a.arc.axis)) for a in base.arcs
        ]
        return {
            "title": t("robot", number=number + 1, name=self._robots[number]),
            "arcs": [_arc(a) for a in base.arcs],
            "pictures": [Markup(picture) for picture in drawn],
            "pose": self._pose_rows(base.T_tracker_base, base.covariance),
            "axes": axes,
        }

    def _remarks(self) -> list[str]:
        """What the checks found, robot by robot, then what no check can settle."""
        language = self._language
        said: list[str] = []
        for number, base in enumerate(self._bases, 1):
            its = [*(w.said(language) for w in base.warnings), *(n.text(language) for n in base.notes)]
            said += [self._t("of_robot", number=number, words=words) for words in its]
        if self._relation is not None:
            said += [w.said(language) for w in self._relation.warnings]
            said += [note.text(language) for note in self._relation.notes]
        return said or [self._of_all("nothing")]


def _errors(found: ArcFit) -> np.ndarray:
    """(n,) [m] how far each point lies off its circle."""
    return np.linalg.norm(found.fit.residuals, axis=1)


def _arc(found: ArcFit) -> tuple[str, ...]:
    """One axis in a row."""
    return (
        str(found.arc.axis),
        str(int(found.used.sum())),
        f"{deg(found.length):.1f}",
        f"{mm(found.radius):.3f}",
        f"{mm(found.rms):.4f}",
        f"{mm(float(_errors(found)[found.used].max())):.4f}",
        f"{HALF * deg(found.sigma_axis):.5f}",
        f"{HALF * mm(found.sigma_centre):.4f}",
    )
