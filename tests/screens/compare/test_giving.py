"""What is taken away for a simulator: the same file as the command writes, and what it cannot carry is said."""

from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace

import pytest

from app.diagnosis.export import export_model, targets
from app.diagnosis.model import ModelEffect, SavedModel
from app.kinematics import load_robot
from app.screens._compare.giving import send_report, send_simulation
from app.screens._compare.taking import TARGETS
from app.texts import text
from tests.diagnosis.report.cases import static_case

MODEL = SavedModel(
    "motion",
    "ur10e",
    (
        ModelEffect("coulomb_friction", {"joint": 2}, {"coulomb": 8.0}),
        ModelEffect("warmup_friction", {"joint": 1}, {"level": 3.0}),
    ),
)


@dataclass
class Desk:
    """As much of a page as giving needs."""

    language: str = "en"
    sent: dict[str, bytes] = field(default_factory=dict)
    said: list[tuple[str, str]] = field(default_factory=list)

    def send(self, name, content):
        self.sent[name] = content

    def say(self, level, words):
        self.said.append((level, words))

    def t(self, key, **fields):
        return text(key, "en", **fields)


@pytest.mark.parametrize("key", TARGETS.values())
def test_the_pendant_gives_the_file_that_the_command_writes(key):
    desk, robot = Desk(), load_robot("ur10e")
    diagnosis = SimpleNamespace(model=MODEL.to_dict(), file="log.csv")
    loaded = SimpleNamespace(diagnosis=diagnosis, robot=robot, path=Path("log.csv"), named=None)
    send_simulation(desk, loaded, key)
    name = f"log.model{targets()[key].suffix}"
    assert desk.sent[name].decode() == export_model(robot, MODEL, key).text
    assert any("warmup_friction" in words and "level 3" in words for _, words in desk.said)


def test_the_report_names_the_description_and_not_where_the_server_keeps_it():
    case = static_case()
    where = Path("/tmp/teachframe-kept/2/robot.urdf")
    desk = Desk()
    send_report(
        desk,
        SimpleNamespace(diagnosis=case, robot=load_robot("ur10e"), path=Path("run.csv"), named=str(where)),
    )
    page = desk.sent["run.report.html"].decode()
    assert "--robot robot.urdf" in page and str(where.parent) not in page


def test_every_target_can_be_chosen():
    assert set(TARGETS.values()) == set(targets())
