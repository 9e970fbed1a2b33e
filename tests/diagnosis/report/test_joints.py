"""The table joint by joint: every value with its deviation, at its joint, under its effect."""

import dataclasses
import re

from app.diagnosis.report.parts.case import Case
from app.diagnosis.report.parts.joints import joints
from app.diagnosis.result import FamilyShare, Parameter
from app.figures import NO_BREAK
from tests.diagnosis.report.cases import compliance, static_case


def found():
    """A soft joint 2, two waves on joint 3, a link and a zero; the zero's family comes first."""
    wave = dataclasses.replace(
        compliance(),
        effect="gear_eccentricity",
        where={"joint": 3, "order": 2},
        parameters=(Parameter("sin", 1e-4, 1e-5, "rad"), Parameter("cos", 2e-4, 1e-5, "rad")),
    )
    link = dataclasses.replace(
        compliance(),
        effect="link_length",
        where={"link": 4, "axis": "a"},
        parameters=(Parameter("offset", 3e-4, 2e-5, "m"),),
    )
    zero = dataclasses.replace(
        compliance(),
        effect="joint_zero",
        where={"joint": 2},
        parameters=(Parameter("offset", 1e-3, 1e-4, "rad"),),
    )
    base = dataclasses.replace(compliance(), effect="base_shift", where={"body": "base", "from_row": 9})
    families = (
        FamilyShare("zeros", 0.5, 0.5, (3,)),
        FamilyShare("geometry", 0.2, 0.4, (2,)),
        FamilyShare("elasticity", 0.2, 0.3, (0,)),
        FamilyShare("gears", 0.1, 0.2, (1,)),
    )
    return dataclasses.replace(
        static_case(), findings=(compliance(), wave, link, zero, base), families=families
    )


def rows(page):
    return [
        re.findall(r"<t[hd][^>]*>([^<]*)</t[hd]>", row)
        for row in re.findall(r"<tr>(.*?)</tr>", page, flags=re.S)
    ]


def test_each_value_stands_at_its_joint_under_its_effect():
    heads, *table = rows(str(joints(Case(found()))).replace(NO_BREAK, " "))
    assert heads == ["± 95%", "Joint zero", "Link length", "Joint compliance", "Gear eccentricity"]
    assert [row[0] for row in table] == ["joint 1", "joint 2", "joint 3", "joint 4"]
    assert table[1][1:] == ["0.057 ± 0.011 deg", "", "12.34 ± 0.80 µrad/Nm", ""]
    assert table[2][4] == "n=2 sin 0.0057 ± 0.0011 deg; n=2 cos 0.0115 ± 0.0011 deg"
    assert table[3][2] == "a 0.300 ± 0.039 mm"


def test_what_belongs_to_no_joint_makes_no_row_and_one_law_no_table():
    assert "base" not in str(joints(Case(found())))
    assert joints(Case(static_case())) == ""
