"""What somebody takes along tells nothing of an exercise that still runs."""

import io
import zipfile

from app.classroom import Room
from app.people.belongings import everything
from app.session import Store
from app.session.actions import Finish, Record
from app.session.owners import Owners
from app.training.cell import begin
from app.training.exercise import exercise


def test_the_seed_of_a_running_exercise_is_given_once_it_has_ended(tmp_path):
    store = Store(tmp_path)
    people = Room(store.database).people
    ada = people.add("ada", "Ada", "trainee", "a long password")
    session = store.create()
    Owners(store.database).give(session.name, ada.owner)
    session.do(Record("touch1"))
    session.do(begin(exercise("first_tool"), 987654321, 0.0, ada.id))

    def given():
        packed = zipfile.ZipFile(io.BytesIO(everything(people, ada, ada.id)))
        return {name: packed.read(name).decode() for name in packed.namelist()}

    running = given()
    assert "987654321" not in "".join(running.values())
    assert (
        '"record"' in running[f"sessions/{session.name}.jsonl"] and f"sessions/{session.name}.txt" in running
    )
    session.do(Finish())
    ended = given()
    assert "987654321" in ended[f"sessions/{session.name}.jsonl"]
    assert f"sessions/{session.name}.txt" not in ended
