"""A trainer gives another PIN: to trainees of his, to nobody who may more."""

import pytest

from app.errors import PersonRefusedError

NEW = "739105"


def test_who_is_locked_out_comes_in_again_with_another_pin(trainer, at, ada, people):
    who = ada.person
    for number in range(10):
        with pytest.raises(PersonRefusedError):
            people.authenticate(who.login, "000001", f"10.1.0.{number}")
    trainer.post(f"/class/{at.id}/pin/{who.id}", pin=NEW)
    assert people.authenticate(who.login, NEW, "here") == people.get(who.id)
    assert any(e.deed == "change_secret" and e.person == trainer.person.id for e in people.audit.read())


def test_a_pin_that_cannot_be_is_one_line(trainer, at, ada, people):
    trainer.post(f"/class/{at.id}/pin/{ada.person.id}", 400, pin="1234")
    with pytest.raises(PersonRefusedError):
        people.authenticate(ada.person.login, "1234", "here")


def test_nobody_takes_over_an_administrator_who_sits_in_his_class(trainer, at, people):
    boss = people.add("boss", "Boss", "administrator", "correct horse battery")
    people.classes.enroll(at.id, boss.id)
    trainer.post(f"/class/{at.id}/pin/{boss.id}", 404, pin=NEW)
    with pytest.raises(PersonRefusedError):
        people.authenticate("boss", NEW, "here")


def test_a_trainee_gives_nobody_a_pin(ada, bo, at, people):
    bo.post(f"/class/{at.id}/pin/{ada.person.id}", 404, pin=NEW)
    with pytest.raises(PersonRefusedError):
        people.authenticate(ada.person.login, NEW, "here")
