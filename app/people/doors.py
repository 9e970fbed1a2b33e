"""What there is to do on a server with accounts, and who may: the one table.

The server asks it at every door, tests go through every door as everybody it names, and docs/doors.md is written from
it. Without accounts, on this machine alone, a browser stands where a person does: its
sessions are its own.
"""

from __future__ import annotations

from dataclasses import dataclass

STRANGER = "stranger"  # not logged in
SELF = "self"  # the session, record or class is his own
HIS_TRAINER = "his_trainer"  # trains a class that its owner is in
TRAINEE = "trainee"  # any other trainee
TRAINER = "trainer"  # any other trainer
ADMINISTRATOR = "administrator"
#: Columns of the table: how somebody stands to what a door leads to.
STANDINGS = (STRANGER, SELF, HIS_TRAINER, TRAINEE, TRAINER, ADMINISTRATOR)
_ALL = frozenset(STANDINGS)
_KNOWN = _ALL - {STRANGER}


@dataclass(frozen=True)
class Door:
    """One thing there is to do.

    Args:
        what: in a few words.
        where: addresses on the server, and commands; what is in capitals is filled in.
        who: standings that are let in.
    """

    what: str
    where: tuple[str, ...]
    who: frozenset[str]


def _door(what: str, where: str, *who: str) -> Door:
    return Door(what, tuple(where.split()), frozenset(who))


DOORS: dict[str, Door] = {
    # Coming in
    "log_in": Door("log in", ("/login", "/login/outside", "/login/outside/back"), _ALL),
    "join": Door("come into a class by its code", ("/join",), _ALL),
    "log_out": Door("log out", ("/logout",), _KNOWN),
    "account": _door("his own account", "/account /account/secret /account/join", SELF),
    # A session, of which the owner is asked about
    "work": _door("work at the pendant", "/ /words /scene /scene/ /state", SELF),
    "upload": _door("send a file", "/upload/WIDGET/DROP", SELF),
    "download": _door("fetch a file", "/download/TOKEN", SELF),
    "open": _door("open, rename or delete a session", "/words", SELF),
    "watch": _door(
        "watch an arm live, without a hand on it",
        "/class/AT/watch/WHO /class/AT/watch/WHO/scene/ /class/AT/watch/WHO/scene /class/AT/watch/WHO/words",
        SELF,
        HIS_TRAINER,
    ),
    "export": _door("take a session as a file", "/words", SELF, HIS_TRAINER),
    "replay": _door("run a session again", "", SELF, HIS_TRAINER),
    "report": _door("read a report", "/words", SELF, HIS_TRAINER),
    "records": _door(
        "read scores", "/words /lessons /lessons/LESSON /class/AT/person/WHO", SELF, HIS_TRAINER
    ),
    "copy": _door("take a copy of a session", "/class/AT/copy/WHO", SELF, HIS_TRAINER),
    "hint": _door("send a hint", "/class/AT/hint/WHO", HIS_TRAINER),
    # Classes, of which the trainer is the owner
    "class_make": _door("make a class", "/classes", TRAINER, ADMINISTRATOR),
    "class_change": _door(
        "see and change a class, its lessons and its members",
        "/class/AT /class/AT/live /class/AT/lessons /class/AT/helps /class/AT/lesson/LESSON /class/AT/dismiss/WHO "
        "/class/AT/scores.csv /class/AT/moodle.csv /class/AT/canvas.csv",
        SELF,
        ADMINISTRATOR,
    ),
    "exercise_make": _door(
        "make an exercise",
        "/exercises /exercises/new /exercises/file /exercises/KEY /exercises/KEY.toml",
        TRAINER,
        ADMINISTRATOR,
    ),
    # People
    "reset": _door("give somebody another PIN, unlock him", "/class/AT/pin/WHO", HIS_TRAINER, ADMINISTRATOR),
    "take_along": _door("take everything kept about a person", "/account/export", SELF, ADMINISTRATOR),
    "erase": _door("erase everything kept about a person", "/account/erase", SELF, ADMINISTRATOR),
    "people": _door("add people, give them roles, shut them out", "", ADMINISTRATOR),
    "audit": _door("read the audit log", "", ADMINISTRATOR),
}


def allowed(deed: str, standing: str) -> bool:
    """True where somebody who stands so may do it; raises KeyError for a deed that is not in the table."""
    return standing in DOORS[deed].who
