"""`teachframe prove`: sealed before it is asked, scored after, shown on a page that stands alone."""

import hashlib
import json
import re

import numpy as np
import pytest

from app import catalog
from app.cli import run
from app.proof.asking import ask
from app.proof.controls import TITLES, draw_control
from app.proof.drawing import STRATA, draw_static, strata_of
from app.proof.drawing_motion import STRATA as MOTION_STRATA
from app.proof.drawing_motion import draw_motion
from app.proof.generator.effects.term import Request
from app.proof.generator.static.making import Plan, make
from app.proof.generator.static.visibility import visibility
from app.recordings import read_table

SMALL = ["clean", "single", "pair", "outside", "alias", "noise", "outliers", "newer", "arm_tracker"]
ALIAS = 2.0  # noise units; below, two explanations are one


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A small run of the whole thing through the command line."""
    import contextlib
    import io

    out = tmp_path_factory.mktemp("proof")
    told = io.StringIO()
    with contextlib.redirect_stdout(told):
        options = ["--cases", "9", "--seed", "11", "--processes", "1", "--strata", *SMALL]
        code = run(["prove", "static", "--out", str(out), *options])
    return out, told.getvalue(), code


def test_the_seal_is_printed_first_and_is_that_of_the_answers(finished):
    out, told, code = finished
    assert code == 0
    seal = hashlib.sha256((out / "answers.json").read_bytes()).hexdigest()
    first = told.splitlines()[0]
    assert seal in first and "seed 11" in first


def test_every_case_was_asked_and_every_stratum_is_there(finished):
    out, _, _ = finished
    answers = json.loads((out / "answers.json").read_text())
    said = json.loads((out / "said.json").read_text())
    assert len(answers) == len(said) == 9
    assert {a["stratum"] for a in answers} == set(SMALL)
    assert all(("verdict" in s) or ("error" in s) for s in said)


def test_no_recording_carries_its_answer(finished):
    out, _, _ = finished
    for path in (out / "recordings").glob("case_*.csv"):
        table = read_table(path)
        allowed = {"kind", "robot", "noise_mm", "payload_com_m", "compliance_rad_per_Nm", "__header_row__"}
        assert set(table.keys) <= allowed, table.keys
    told = [p.name for p in (out / "recordings").glob("*.json")]
    assert all(name.endswith(".model.json") for name in told)  # what the diagnosis learnt, not what is true


def test_the_scorecard_says_every_rate_with_an_interval_beside_its_aim(finished):
    out, told, _ = finished
    card = json.loads((out / "scorecard.json").read_text())
    assert card["format"] == "teachframe.proof/1" and card["seed"] == 11
    lines = {line["key"]: line for line in card["lines"]}
    assert {"clean", "one_place", "one_name", "set", "outside", "error", "arm_transfer", "arm_self"} <= set(
        lines
    )
    for line in lines.values():
        low, high = line["interval"]
        assert low <= line["value"] <= high
    assert lines["clean"]["aim"] == 0.01 and lines["one_name"]["aim"] == 0.99
    assert "clean, falsely named" in told and set(card["controls"]) == set(TITLES)
    assert lines["error"]["value"] == 0.0, [f for f in card["failures"] if f["verdict"] == "error"]


def test_the_page_needs_nothing_from_outside_and_shows_every_failure(finished):
    out, _, _ = finished
    page = (out / "scorecard.html").read_text()
    card = json.loads((out / "scorecard.json").read_text())
    assert not re.search(r"(src|href)\s*=|@import|url\(", page)
    assert card["answers_sha256"] in page and card["command"] in page
    for failure in card["failures"]:
        assert failure["case"] in page


@pytest.mark.parametrize("stratum", sorted(catalog.members(STRATA, "STRATUM")))
def test_a_static_case_is_the_same_whenever_it_is_drawn(stratum, tmp_path):
    first, second = tmp_path / "a", tmp_path / "b"
    first.mkdir(), second.mkdir()
    answers = [json.dumps(draw_static(3, 1, stratum, folder)) for folder in (first, second)]
    assert answers[0] == answers[1]
    assert (first / "case_0001.csv").read_bytes() == (second / "case_0001.csv").read_bytes()


@pytest.mark.parametrize("stratum", ["clean", "clutter", "outside"])
def test_a_motion_case_is_a_log_that_can_be_read(stratum, tmp_path):
    answer = draw_motion(3, 1, stratum, tmp_path)
    table = read_table(tmp_path / f"{answer['id']}.csv")
    assert table.kind == "motion" and table.has("t", "q6")
    assert answer["stratum"] == stratum and len(answer["truth"]) == (stratum != "clean")
    assert stratum in catalog.members(MOTION_STRATA, "STRATUM")


def test_a_stratum_that_is_not_there_is_refused_with_those_that_are(tmp_path, capsys):
    assert run(["prove", "static", "--strata", "arm_trakcer", "--out", str(tmp_path / "out")]) == 2
    assert "arm_tracker" in capsys.readouterr().err


def test_strata_share_the_cases_and_none_is_left_out():
    drawn = strata_of([STRATA], 500)
    assert len(drawn) == 500 and drawn.count("clean") >= 90 and drawn.count("alias") >= 20
    assert len(strata_of([STRATA], 3)) == 3
    assert set(strata_of([STRATA], 10)) == set(catalog.members(STRATA, "STRATUM"))


@pytest.mark.parametrize("kind", sorted(TITLES))
def test_controls_are_drawn_as_they_are_described(kind, tmp_path):
    control = draw_control(5, 0, kind, tmp_path)
    table = read_table(control.path)
    assert bool(control.without) == (kind == "without")
    assert table.has("temperature") == (kind == "response")


def test_the_law_taken_out_for_a_control_is_back_afterwards(tmp_path):
    control = draw_control(5, 0, "without", tmp_path)
    before = list(catalog.members("app.diagnosis.effects.kinematic", "EFFECT").items())
    said = ask(control.path, control.without)
    assert control.without not in [f["effect"] for f in said.get("findings", ())]
    assert list(catalog.members("app.diagnosis.effects.kinematic", "EFFECT").items()) == before


def _seen(request, geometry=False, kind="touch", topology="offset_wrist"):
    family = catalog.member("app.proof.generator.topologies", "TOPOLOGY", topology, what="topology")
    rng = np.random.default_rng(6)
    arm = family.draw(rng)
    made = make(Plan(kind=kind, samples=60, noise=1e-4), arm, arm, [request], rng)
    return visibility(made, 0, geometry=geometry, limit=ALIAS)


@pytest.mark.parametrize(
    "request_",
    [
        Request("joint_zero", {"joint": 1}),
        Request("joint_zero", {"joint": 6}),
        Request("link_length", {"link": 6, "axis": "d"}),
        Request("touch_indentation"),
    ],
)
def test_what_theory_says_is_hidden_in_base_and_tool_does_not_survive(request_):
    assert _seen(request_).survives < 1e-3


def test_lengths_along_parallel_axes_are_found_to_be_one_class():
    alike = _seen(Request("link_length", {"link": 2, "axis": "d"})).lookalikes
    links = {
        a["where"].get("link") for a in alike if a["effect"] == "link_length" and a["where"]["axis"] == "d"
    }
    assert {3, 4} <= links


def test_instrument_scale_hides_in_the_lengths_once_geometry_is_free_and_not_before():
    request = Request("instrument_scale")
    assert _seen(request, geometry=False, kind="tracker").survives > 0.5
    assert _seen(request, geometry=True, kind="tracker").survives < 1e-2


def test_a_visible_effect_survives_and_has_no_alias():
    seen = _seen(Request("joint_coupling", {"joint": 5, "source_joint": 4}), kind="tracker")
    assert seen.survives > 1.5 and seen.lookalikes == ()


@pytest.mark.parametrize("options", [["nothing"], ["static", "--cases", "0"], ["static", "--seed", "-1"]])
def test_what_cannot_be_proven_is_refused_in_one_line(options, tmp_path, capsys):
    assert run(["prove", *options, "--out", str(tmp_path / "out")]) == 2
    assert len(capsys.readouterr().err.strip().splitlines()) == 1
