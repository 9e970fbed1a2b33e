"""Whatever stands in a points file, only the project's own errors come out, in one line."""

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.calibration.as_json import solved_json
from app.calibration.solving import solve_file
from app.calibration.text import page
from app.errors import TeachframeError
from app.resources import STATIC
from tests.calibration.fuzzing import EXAMPLES

GOOD = (STATIC / "samples" / "xiong2012_table1.csv").read_text(encoding="utf-8")
QUATERNIONS = "# angles: quaternion\nrole,x_mm,y_mm,z_mm,qw,qx,qy,qz\n" + "".join(
    f"touch,{100 * i},0,0,{np.cos(i / 4)},{np.sin(i / 4) if i % 2 else 0},{0 if i % 2 else np.sin(i / 4)},0\n"
    for i in range(5)
)
WORDS = [
    "nan",
    "inf",
    "1e308",
    "-1e-320",
    ",",
    "\n",
    "\n\n",
    "#",
    "# angles: rotvec\n",
    '"',
    "touch",
    "origin+x",
]
PIECES = st.one_of(st.text(max_size=10), st.sampled_from([*WORDS, ":", "[", "\x00", "\ufeff", "é"]))
ROLES = st.sampled_from(["touch", "touch+origin", "x", "z", "y", "known"])
FUZZ = {"deadline": None, "suppress_health_check": [HealthCheck.function_scoped_fixture]}
NUMBERS = st.one_of(st.floats(), st.floats(-2000, 2000), st.integers(-(10**20), 10**20))


def attempt(path):
    try:
        solved = solve_file(path)
        assert page(solved)
        assert len(solved_json(solved)["tool_mm"]) == 3
    except TeachframeError as error:
        assert "\n" not in str(error) and str(path) in str(error)


@settings(
    max_examples=EXAMPLES["spoilt points file"],
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(data=st.data())
def test_mangled_points_files_give_the_projects_errors_only(data, tmp_path):
    text = data.draw(st.sampled_from([GOOD, QUATERNIONS]))
    for _ in range(data.draw(st.integers(1, 4))):
        a, b = sorted((data.draw(st.integers(0, len(text))), data.draw(st.integers(0, len(text)))))
        b = min(b, a + 40)
        text = text[:a] + data.draw(PIECES) + text[b:]
    path = tmp_path / "points.csv"
    path.write_text(text, encoding="utf-8", newline="")
    attempt(path)


@settings(
    max_examples=EXAMPLES["any numbers"],
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(
    angles=st.sampled_from(["ZYX", "ZYZ", "XYZ", "rotvec"]),
    rows=st.lists(st.tuples(ROLES, st.lists(NUMBERS, min_size=6, max_size=6)), max_size=9),
)
def test_any_numbers_in_a_well_formed_file_give_a_result_or_the_projects_errors(angles, rows, tmp_path):
    lines = [f"# angles: {angles}", "role,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg"]
    lines += [role + "," + ",".join(str(v) for v in values) for role, values in rows]
    path = tmp_path / "points.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    attempt(path)


@settings(
    max_examples=EXAMPLES["any bytes"],
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(data=st.binary(max_size=600))
def test_any_bytes_give_the_projects_errors_only(data, tmp_path):
    path = tmp_path / "points.csv"
    path.write_bytes(data)
    attempt(path)
