"""The page in the reader's language: nothing of its own stays English, and English stays what it was."""

import dataclasses
import re
from html import unescape
from types import SimpleNamespace

import pytest

from app.diagnosis.judging import BARE, WITH
from app.diagnosis.report import as_page
from app.diagnosis.report.picture_words import in_language
from app.diagnosis.result import Diagnosis, Judged, Quality
from app.figures import NO_BREAK
from app.kinematics import load_robot
from app.screens._compare.giving import send_report
from tests.diagnosis.report.cases import compliance, motion_case, static_case

COMMAND = "teachframe diagnose x.csv --report x.html"
HAN = re.compile(r"[\u4e00-\u9fff]")
#: Words of three letters and more that a Chinese page may carry inside its own sentences.
SYMBOLS = {"deg", "rad", "BIC", "min", "sign"}  # the last one of laws
NAMES = {
    "Teachframe",
    "Universal",
    "Robots",
    "UR10e",
    "Stribeck",
    "cell_7",
    "log_a",
    "csv",
    "learnt",
    "json",
    "tf6",
}
#: Parameters that only the cases made by hand know; those of the engines have words.
MADE_UP = {"level", "force"}
#: What engines remark stays English; so does the command, which is typed and not read.
REMARKS = {
    "Rows 12 and 13 are the same to the last digit; one of them was used.",
    "Speed by a zero-phase Butterworth filter, order 4, 12 Hz.",
    COMMAND,
}


def every_section() -> dict[str, Diagnosis]:
    """Diagnoses that between them fill every section and every turn of phrase."""
    steps = {BARE: Quality(1.0, 1.2, "mm"), WITH: Quality(0.2, 0.21, "mm")}
    torques = {BARE: Quality(1.0, 1.2, "Nm"), WITH: Quality(0.2, 0.21, "Nm")}
    alone = dataclasses.replace(compliance(), alternatives=())
    return {
        "clean": static_case("clean"),
        "named": static_case(),
        "partly": static_case("partly"),
        "unexplained": static_case("unexplained"),
        "touch": dataclasses.replace(static_case(), kind="touch"),
        "motion": motion_case(),
        "motion judged": dataclasses.replace(motion_case(), judged=Judged("", torques)),
        "judged": dataclasses.replace(static_case(), judged=Judged("learnt.json", steps)),
        "many": dataclasses.replace(
            static_case(), findings=(alone,) * 4, families=(), outliers=tuple(range(5, 60))
        ),
        "no finding": dataclasses.replace(motion_case(), findings=(), families=()),
    }


def page(case, robot=None, **more):
    made = as_page([case], [robot], command=COMMAND, date="2030-01-01 12:00", **more)
    return made.replace(NO_BREAK, " ")


def said(text: str) -> set[str]:
    """What a reader sees or is read: text between tags, and the titles of pictures."""
    text = re.sub(r"<style>.*?</style>", "", text, flags=re.S)
    found = re.findall(r">([^<>]+)<", text) + re.findall(r'aria-label="([^"]*)"', text)
    return {unescape(one) for one in found}


def english(words: set[str]) -> set[str]:
    """Those with an English word in them that is neither a symbol nor a name."""
    return {
        one
        for one in words - REMARKS
        if set(re.findall(r"[A-Za-z_][A-Za-z_0-9]{2,}", one)) - SYMBOLS - NAMES - MADE_UP
    }


@pytest.mark.parametrize("robot", [None, "ur10e"])
@pytest.mark.parametrize("name", every_section())
def test_the_chinese_page_leaves_no_english_of_its_own(name, robot):
    text = page(every_section()[name], load_robot(robot) if robot else None, language="zh")
    assert '<html lang="zh">' in text
    assert english(said(text)) == set()


def test_what_looks_for_english_finds_it():
    assert "What was left out" in english(said(page(static_case())))


def test_english_is_what_a_page_speaks_without_being_told():
    for case in every_section().values():
        text = page(case)
        assert text == page(case, language="en")
        assert not HAN.search(text) and '<html lang="en">' in text


@pytest.mark.parametrize("name", every_section())
def test_both_languages_show_the_same_pictures_and_tables(name):
    case = every_section()[name]
    for shape in (r"<path[^>]*>", r"<rect[^>]*>", r"<(?:section|tr|td|dt|dd|li|figure|svg)\b"):
        in_english, in_chinese = (
            [re.sub(r"clip\d+", "clip", found) for found in re.findall(shape, page(case, language=language))]
            for language in ("en", "zh")
        )
        assert in_english == in_chinese


def test_a_label_made_of_two_is_said_whole_and_an_unknown_one_stays():
    both = in_language("joint 2 off by [deg] against angle of joint 3 [deg]", "zh")
    assert both == "关节 2 偏差 [deg]，随关节 3 的角度 [deg] 变化"
    assert in_language("phase of the moon", "zh") == "phase of the moon"


@pytest.mark.parametrize(("language", "head"), [("en", "What was left out"), ("zh", "描述遗漏了什么")])
def test_the_pendant_hands_the_report_out_in_the_operators_language(tmp_path, language, head):
    sent = {}
    pendant = SimpleNamespace(
        language=language,
        send=lambda name, content: sent.update({name: content}),
        say=lambda *_: None,
        t=lambda key, **_: key,
    )
    loaded = SimpleNamespace(
        diagnosis=static_case(), robot=load_robot("ur10e"), named="ur10e", path=tmp_path / "cell_7.csv"
    )
    send_report(pendant, loaded)  # type: ignore[arg-type]
    assert f"<h2>{head}</h2>" in sent["cell_7.report.html"].decode()
