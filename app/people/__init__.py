"""Who learns and who teaches here: accounts, classes, log-ins, what each may do. No web in it.

    tables.py    people, log-ins, classes, members, the audit log, tries: tables of the sessions' database
    people.py    People: accounts; the way to everything else here
    secret.py    passwords and PINs: argon2
    logins.py    browsers that are logged in, until when
    classes.py   classes, their codes, who is in them
    doors.py     what there is to do, and who may: the one table; tests and docs/doors.md are made from it
    belongings.py  everything kept about a person: given to him, or erased
    audit.py     what was done, by whom: a log that only grows
    tries.py     how often somebody has done something lately, in the database
    bulk.py      how many bytes he has sent lately, in the database too
    meter.py     the same in memory, for what is counted many times a second
    limits.py    how much a person may do: the one place
    keys.py      the key that cookies are signed with
    refusals.py  why not, in English and Chinese

A person's sessions, scores and files hang on an owner string, as a browser's do on a server without accounts; that of
a person is made from his id. His scores are kept under his id, so that nobody can call himself another.
"""

from app.people.people import People, Person, Role

__all__ = ["People", "Person", "Role"]
