"""Accounts: who is let in, who is locked out, what is refused, what the log keeps."""

import io
import time
import zipfile

import pytest
from sqlalchemy import text

from app.errors import PersonRefusedError, StorageError
from app.people import limits
from app.people.belongings import erase, everything
from app.people.doors import DOORS, HIS_TRAINER, SELF, STANDINGS, STRANGER
from app.people.tables import LOGINS, PEOPLE
from tests.conftest import AT_FULL_COST, NOBODY_AT_FULL_COST
from tests.people.conftest import HERE, PASSWORD, PIN


def refused(why):
    return pytest.raises(PersonRefusedError, check=lambda error: error.why == why)


def test_who_has_the_password_is_let_in(people):
    made = people.add("Ann", "Ann A.", "trainer", PASSWORD)
    assert people.authenticate(" ANN ", PASSWORD, HERE) == made == people.find("ann") == people.get(made.id)


@pytest.mark.parametrize(
    "login, secret", [("ann", "something else"), ("bob", PASSWORD), ("ann", ""), ("", "")]
)
def test_a_wrong_name_and_a_wrong_password_get_the_same_answer(people, login, secret):
    people.add("ann", "Ann", "trainee", PASSWORD)
    with refused("wrong"):
        people.authenticate(login, secret, HERE)


def test_secrets_are_not_kept(people):
    people.add("ann", "Ann", "trainee", PASSWORD)
    with people.database.begin() as connection:
        rows = str(connection.execute(PEOPLE.select()).all())
    assert PASSWORD not in rows and "$argon2id$" in rows


def test_the_sixth_try_in_a_minute_is_not_looked_at_though_it_is_right(people):
    people.add("ann", "Ann", "trainee", PASSWORD)
    for _ in range(limits.TRIES.most):
        with refused("wrong"):
            people.authenticate("ann", "not it at all", HERE)
    with refused("slowly"):
        people.authenticate("ann", PASSWORD, HERE)
    assert people.authenticate("ann", PASSWORD, "10.0.0.2")


def test_tries_under_many_names_from_one_address_end_too(people):
    for number in range(limits.TRIES_OF_ADDRESS.most):
        with refused("wrong"):
            people.authenticate(f"name{number}", "x", HERE)
    with refused("slowly"):
        people.authenticate("another", "x", HERE)


def test_an_account_is_locked_after_wrong_tries_from_many_places_and_opens_again(people, monkeypatch):
    people.add("ann", "Ann", "trainee", PASSWORD)
    for number in range(limits.FAILED):
        with refused("wrong"):
            people.authenticate("ann", "not it at all", f"10.0.0.{number}")
    with refused("locked"):
        people.authenticate("ann", PASSWORD, HERE)
    now = time.time()
    monkeypatch.setattr("app.people.people.time.time", lambda: now + limits.LOCKED + 1.0)
    assert people.authenticate("ann", PASSWORD, HERE)


def test_a_clock_that_was_set_back_locks_nobody_out_for_longer(people, monkeypatch):
    people.add("ann", "Ann", "trainee", PASSWORD)
    for number in range(limits.FAILED):
        with refused("wrong"):
            people.authenticate("ann", "not it at all", f"10.0.0.{number}")
    now = time.time()
    monkeypatch.setattr("time.time", lambda: now - 86400.0)
    assert people.authenticate("ann", PASSWORD, HERE)


def test_another_pin_unlocks_and_logs_out_everywhere(people):
    ann = people.add("ann", "Ann", "trainee", PASSWORD)
    browser = people.logins.begin(ann.id)
    for number in range(limits.FAILED):
        with refused("wrong"):
            people.authenticate("ann", "not it at all", f"10.0.0.{number}")
    people.change(ann.id, pin=PIN)
    assert people.authenticate("ann", PIN, HERE)
    assert people.logins.person(browser) is None


@pytest.mark.parametrize(
    "pin", ["12345", "111111", "123456", "987654", "1234567890123", "48291a", "", "４８２９１５"]
)
def test_a_pin_that_is_guessed_first_is_refused(people, pin):
    trainer = people.add("t", "T", "trainer", PASSWORD)
    at = people.classes.make("A", trainer.id)
    with refused("pin"):
        people.join(at.code, "Li Wei", pin, HERE)


@pytest.mark.parametrize("password", ["short", "aaaaaaaaaaaaaaaa", "x" * 5000, ""])
def test_a_password_that_is_none_is_refused(people, password):
    with refused("password"):
        people.add("ann", "Ann", "trainee", password)


@pytest.mark.parametrize("login", ["", " ", "a b", "x" * 500, "a\x00b"])
def test_a_log_in_name_that_is_none_is_refused(people, login):
    with refused("login"):
        people.add(login, "Ann", "trainee", PASSWORD)


def test_a_name_is_taken_once_whatever_its_letters(people):
    people.add("ann", "Ann", "trainee", PASSWORD)
    with refused("taken"):
        people.add("ＡＮＮ", "Ann", "trainee", PASSWORD)


def test_a_class_is_joined_by_code_name_and_pin_and_again_by_the_same(school, people):
    code = school["class1"].code
    again = people.join(f" {code[:4].upper()}-{code[4:]} ", "trainee  1", PIN, HERE)
    assert again == school["trainee1"] and people.classes.members(school["class1"].id) == [again.id]


def test_another_pin_is_not_let_in_under_a_name_that_is_taken(school, people):
    with refused("wrong"):
        people.join(school["class1"].code, "Trainee 1", "739105", HERE)


def test_an_old_code_and_a_deleted_class_let_nobody_in(school, people):
    people.classes.new_code(school["class1"].id)
    people.classes.delete(school["class2"].id)
    for number in (1, 2):
        with refused("no_class"):
            people.join(school[f"class{number}"].code, "New", PIN, HERE)
    assert people.authenticate(school["trainee2"].login, PIN, HERE) == school["trainee2"]


def test_a_class_holds_so_many(school, people, monkeypatch):
    monkeypatch.setattr("app.people.classes.MEMBERS", 1)
    with refused("full"):
        people.join(school["class1"].code, "One more", PIN, HERE)


def test_a_log_in_ends_when_it_rests_at_its_time_and_by_hand(school, people, monkeypatch):
    person = school["trainee1"].id
    browser, now = people.logins.begin(person), time.time()
    assert people.logins.person(browser) == person and people.logins.person("another") is None
    monkeypatch.setattr("app.people.logins.time.time", lambda: now + limits.IDLE + 1.0)
    assert people.logins.person(browser) is None
    for step in range(1, 13):  # somebody works all day
        monkeypatch.setattr("app.people.logins.time.time", lambda step=step: now + step * 3590.0)
        assert people.logins.person(browser) == person
    monkeypatch.setattr("app.people.logins.time.time", lambda: now + limits.LOGIN + 1.0)
    assert people.logins.person(browser) is None
    other = people.logins.begin(person)
    people.logins.end(other)
    assert people.logins.person(other) is None


def test_a_clock_alone_keeps_no_log_in_alive(school, people, monkeypatch):
    browser, now = people.logins.begin(school["trainee1"].id), time.time()
    for step in range(1, 5):
        monkeypatch.setattr("app.people.logins.time.time", lambda step=step: now + step * 1790.0)
        assert people.logins.person(browser, alive=False)
    monkeypatch.setattr("app.people.logins.time.time", lambda: now + limits.IDLE + 1.0)
    assert people.logins.person(browser, alive=False) is None


def test_a_browsers_secret_is_not_kept(school, people):
    browser = people.logins.begin(school["trainee1"].id)
    with people.database.begin() as connection:
        assert browser not in str(connection.execute(LOGINS.select()).all())


def test_who_is_shut_out_is_out_at_once(school, people):
    browser = people.logins.begin(school["trainee1"].id)
    people.change(school["trainee1"].id, disabled=True)
    assert people.logins.person(browser) is None
    with refused("wrong"):
        people.authenticate(school["trainee1"].login, PIN, HERE)


def test_the_last_administrator_stays_one(school, people):
    admin = school["administrator"].id
    for change in ({"role": "trainee"}, {"disabled": True}):
        with refused("last_administrator"):
            people.change(admin, **change)
    with refused("last_administrator"):
        erase(people, school["administrator"], admin)
    people.add("second", "Second", "administrator", PASSWORD)
    assert people.change(admin, role="trainee").role == "trainee"


def test_a_trainer_with_classes_stays_one(school, people):
    with refused("has_classes"):
        people.change(school["trainer1"].id, role="trainee")
    with refused("has_classes"):
        erase(people, school["trainer1"], school["trainer1"].id)


@pytest.mark.parametrize(
    "change", ["DELETE FROM audit", "UPDATE audit SET person = ''", "DELETE FROM audit WHERE id=1"]
)
def test_the_audit_log_only_grows(school, people, change):
    before = people.audit.read()
    assert len(before) > 5
    with pytest.raises(StorageError), people.database.begin() as connection:
        connection.execute(text(change))
    assert people.audit.read() == before


def test_who_is_erased_stays_an_id_in_the_log_and_nothing_else(school, people):
    gone = school["trainee1"]
    erase(people, gone, school["administrator"].id)
    assert people.get(gone.id) is None and people.classes.members(school["class1"].id) == []
    entries = people.audit.read(person=gone.id)
    assert entries[0].deed == "erase" and entries[0].person == school["administrator"].id
    assert gone.name not in str(entries) and gone.login not in str(entries)


def test_how_people_stand_to_each_other(school, people):
    theirs = school["trainee1"].owner
    at = lambda who: people.standings(school.get(who), theirs)  # noqa: E731
    assert at("trainee1") == {SELF} and at("trainer1") == {HIS_TRAINER} and at("nobody") == {STRANGER}
    assert at("trainee2") == {"trainee"} and at("trainer2") == {"trainer"}
    assert at("administrator") == {"administrator"}
    people.classes.change(school["class1"].id, trainer=school["administrator"].id)
    assert at("administrator") == {"administrator", HIS_TRAINER} and at("trainer1") == {"trainer"}
    people.classes.dismiss(school["class1"].id, school["trainee1"].id)
    assert at("administrator") == {"administrator"}


@pytest.mark.parametrize("deed", sorted(DOORS))
def test_the_table_is_what_is_asked(school, people, deed):
    theirs = school["trainee1"].owner
    asked = {
        STRANGER: None,
        SELF: school["trainee1"],
        HIS_TRAINER: school["trainer1"],
        "trainee": school["trainee2"],
        "trainer": school["trainer2"],
        "administrator": school["administrator"],
    }
    assert set(asked) == set(STANDINGS)
    for standing, person in asked.items():
        assert people.may(person, deed, theirs) == (standing in DOORS[deed].who), standing


def test_every_refusal_is_a_sentence_in_both_languages():
    from app.texts import TEXTS

    english, chinese = (
        {k for k in TEXTS.languages[x] if k.startswith("people.refused.")} for x in ("en", "zh")
    )
    assert english == chinese and len(english) > 10


def test_what_a_later_table_holds_of_him_is_given_and_erased_too(school, people):
    gone, other = school["trainee1"], school["trainee2"]
    with people.database.begin() as connection:
        connection.execute(text("CREATE TABLE later (owner VARCHAR(64), words TEXT)"))
        for person in (gone, other):
            connection.execute(text(f"INSERT INTO later VALUES ('{person.owner}', 'of {person.name}')"))
    packed = zipfile.ZipFile(io.BytesIO(everything(people, gone, gone.id)))
    assert "of Trainee 1" in packed.read("later.jsonl").decode()
    assert "Trainee 2" not in str([packed.read(name) for name in packed.namelist()])
    erase(people, gone, gone.id)
    with people.database.begin() as connection:
        assert connection.execute(text("SELECT words FROM later")).scalars().all() == ["of Trainee 2"]


def test_a_trainer_takes_along_what_he_made(school, people):
    packed = zipfile.ZipFile(io.BytesIO(everything(people, school["trainer1"], "")))
    assert "Class 1" in packed.read("classes.jsonl").decode()
    assert "Class 2" not in packed.read("classes.jsonl").decode()


def test_secrets_are_kept_at_the_librarys_full_cost_on_one_core():
    for kept in (AT_FULL_COST.hash("x"), NOBODY_AT_FULL_COST):
        assert kept.startswith("$argon2id$v=19$m=65536,t=3,p=1$")
