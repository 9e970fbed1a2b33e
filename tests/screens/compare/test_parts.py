"""The Compare screen's parts without a browser: the ghost, the hidden fault, what is kept, the pictures."""

import re
import time

import numpy as np
import pytest

from app.kinematics import load_robot
from app.screens._compare import plots
from app.screens._compare.ghost import joints_for_point
from app.screens._compare.hidden import FAULTS, KINDS, MOTION_FAULTS, make_hidden
from app.screens._compare.jobs import search
from app.screens._compare.kept import _MOST, kept_for
from app.screens._compare.loaded import load
from tests.diagnosis.report.cases import motion_case, static_case

GHOST_TOLERANCE = 1e-4  # m
NOISE = 1.5e-4  # m, of the simulated cell


@pytest.fixture(scope="module")
def hidden(tmp_path_factory):
    folder = tmp_path_factory.mktemp("hidden")
    path, truth = make_hidden("ur10e", "tracker", folder, 3)
    return load(path, truth=truth)


def test_the_ghosts_tool_stands_where_it_is_wanted_with_the_smallest_move():
    robot = load_robot("ur10e")
    tip = np.array([0.05, -0.02, 0.15])
    q = robot.home + 0.2
    start = robot.forward(q).apply(tip)
    wanted = start + np.array([0.06, -0.05, 0.08])
    ghost = joints_for_point(robot, q, tip, wanted)
    assert np.linalg.norm(robot.forward(ghost).apply(tip) - wanted) < GHOST_TOLERANCE
    assert np.abs(ghost - q).max() < 0.3
    assert np.array_equal(joints_for_point(robot, q, tip, start), q)


@pytest.mark.parametrize("kind", KINDS)
def test_a_hidden_fault_leaves_nothing_of_itself_beside_the_recording(tmp_path, kind):
    path, truth = make_hidden("ur10e", kind, tmp_path, 11)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]
    assert len(truth) == 1 and truth[0]["effect"] in (MOTION_FAULTS if kind == "motion" else FAULTS)
    assert truth[0]["effect"] not in path.read_text(encoding="utf-8")


def test_before_the_search_the_bare_description_stands_beside_the_recording(hidden):
    assert hidden.diagnosis is None and hidden.points is not None
    assert np.array_equal(hidden.vectors(0.0), hidden.vectors(1.0))
    off = np.linalg.norm(hidden.vectors(0.0), axis=1)
    assert off[hidden.worst] == off.max() > 2 * NOISE


def test_the_findings_shrink_the_arrows(hidden):
    found = search(hidden.path, None, None, lambda share, doing: None)
    after = hidden.with_diagnosis(found)
    assert found.findings
    size = [np.linalg.norm(after.vectors(share), axis=1).mean() for share in (0.0, 0.5, 1.0)]
    assert size[0] > size[1] > size[2]
    assert not after.applied


def test_the_search_says_how_far_it_is(hidden):
    said = []
    search(hidden.path, None, None, lambda share, doing: said.append((share, doing)))
    shares = [share for share, _ in said]
    assert len(said) >= 3 and min(shares) >= 0.0 and max(shares) <= 1.0
    assert all(doing for _, doing in said)


def test_what_a_session_loaded_outlives_its_page_but_not_many_others():
    first = kept_for("first")
    folder = first.folder
    assert kept_for("first") is first and folder.is_dir()
    del first
    for number in range(_MOST):
        kept_for(f"other {number}")
    for _ in range(100):
        if not folder.exists():
            break
        time.sleep(0.01)
    assert not folder.exists()


def test_pictures_keep_their_style_to_themselves():
    for picture in (plots.bars(static_case()), plots.trace(motion_case().evidence, 2, motion_case(), 4.5)):
        style = re.search(r"<style>(.*?)</style>", picture).group(1)
        selectors = [s for rule in re.findall(r"([^{}]+)\{", style) for s in rule.split(",")]
        assert selectors and all(s.startswith(".tf-plot ") for s in selectors)


def test_a_trace_marks_the_shown_moment_and_the_contact():
    case = motion_case()
    picture = plots.trace(case.evidence, 1, case, 6.0)
    assert 'class="now"' in picture and 'class="window"' in picture


def test_the_two_colours_are_named_beside_the_bars():
    for language, words in (("en", ("description alone", "with what was found")), ("zh", ())):
        drawn = plots.bars(static_case(), language)
        assert all(word in drawn for word in words)
        assert drawn.count('class="legend') == 2
    log = motion_case()
    assert plots.trace(log.evidence, 1, log, None, "en").count('class="legend') == 3
    assert (
        plots.trace(log.evidence, 1, None, None, "en").count('class="legend') == 2
    )  # nothing was searched for


def test_a_family_without_a_law_of_its_own_is_listed_where_it_would_be_missed(desk):
    from dataclasses import replace

    from app.diagnosis.report.budget import shown
    from app.screens._compare import cards

    case = static_case()
    bare = replace(case, families=tuple(replace(f, members=()) for f in case.families))
    said = cards.findings(desk.context, bare)
    assert all(s.members == () for s in shown(plots.budget(bare)))
    named = [f for f in bare.families if f.share > 0.1]
    assert named and said.count("block family") >= len(named)
    assert "comes back without it" in said


def test_a_family_that_adds_nothing_but_would_be_missed_has_a_dash_with_a_note(desk):
    from dataclasses import replace

    from app.diagnosis.result import FamilyShare
    from app.screens._compare import cards

    case = static_case()
    first = case.families[0]
    late = FamilyShare("play", 0.03, first.heldout_rms_after, ())
    said = cards.findings(desk.context, replace(case, families=(first, late)))
    assert "play · –" in said and "compare-shared" in said and "play · 0" not in said
    assert "compare-shared" not in cards.findings(desk.context, replace(case, families=(first,)))
    # One that is not listed, since it is small and nobody would miss it, leaves no note behind.
    small = replace(late, share=0.01)
    assert "compare-shared" not in cards.findings(desk.context, replace(case, families=(first, small)))
