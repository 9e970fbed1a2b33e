"""A found model in the session: kept in the journal, refused where it means nothing."""

import pytest

from app.diagnosis.model import ModelEffect, SavedModel
from app.errors import ActionRefusedError
from app.session import Store, reduce
from app.session.actions import ChooseRobot, Undo, UseModel
from app.session.state import first_state

MODEL = SavedModel(
    "static",
    "ur10e",
    (ModelEffect("joint_zero", {"joint": 3}, {"offset": 0.004}),),
    {"tools": [0.1]},
    "run.csv",
)


def test_the_model_of_the_practice_cell_outlives_a_restart(tmp_path):
    store = Store(tmp_path)
    session = store.create(robot="ur10e")
    session.do(UseModel(MODEL))
    session.close()
    again = store.open(session.name)
    assert again.state.cell_model == MODEL
    again.do(Undo())
    assert again.state.cell_model is None
    again.close()


def test_another_arm_comes_as_described():
    state = reduce(first_state("ur10e"), UseModel(MODEL))
    assert reduce(state, ChooseRobot("ur5")).cell_model is None
    assert reduce(state, UseModel(None)).cell_model is None


@pytest.mark.parametrize(
    "model, code",
    [
        (SavedModel("motion", "ur10e"), "model_kind"),
        (SavedModel("static", "iiwa7"), "model_robot"),
        (
            SavedModel("static", "ur10e", (ModelEffect("joint_zero", {"joint": 9}, {"offset": 1.0}),)),
            "unknown",
        ),
        (SavedModel("static", "ur10e", (ModelEffect("telepathy", {}, {}),)), "unknown"),
        (SavedModel("static", "ur10e", (ModelEffect("joint_zero", {"joint": 1}, {}),)), "unknown"),
    ],
)
def test_a_model_that_means_nothing_here_is_refused(model, code):
    with pytest.raises(ActionRefusedError) as refused:
        reduce(first_state("ur10e"), UseModel(model))
    assert refused.value.code == code
