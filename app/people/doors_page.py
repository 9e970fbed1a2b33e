"""docs/doors.md, written from the table of doors."""

from __future__ import annotations

from app.people import limits
from app.people.doors import DOORS, STANDINGS

_TITLES = {
    "stranger": "not logged in",
    "self": "himself",
    "his_trainer": "his class's trainer",
    "trainee": "another trainee",
    "trainer": "another trainer",
    "administrator": "administrator",
}
_HEAD = """# Doors: what there is to do, and who may

Written from `app/people/doors.py`, the table that the server asks (`make golden` writes it anew). Columns say how
somebody stands to the owner of what a door leads to: of a session, a score, a class (its trainer) or an account.
`tests/people/test_people.py` asks the table as everybody, `tests/shell/accounts` goes through the doors of
the server as everybody; a path that is served and does not stand here fails a test. Where no address is named, the
door is a page of the class, or a command (`teachframe people`, `class`, `audit`), which whoever may read the
database file may give.

On a server without accounts, on this machine alone, a browser stands where a person does: everything of its own,
nothing of others.

"""


def doors_page() -> str:
    """The page."""
    titles = [_TITLES[standing] for standing in STANDINGS]
    rows = [["door", "where", *titles], ["---"] * (len(titles) + 2)]
    for key, door in DOORS.items():
        where = " ".join(f"`{path}`" for path in door.where)
        rows.append([f"{door.what} (`{key}`)", where, *("yes" if s in door.who else "" for s in STANDINGS)])
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    return _HEAD + "\n".join(lines) + "\n\n" + _limits()


def _limits() -> str:
    per = {
        "log-in tries under one name from one address": limits.TRIES,
        "log-in tries from one address": limits.TRIES_OF_ADDRESS,
        "requests of one log-in": limits.REQUESTS,
        "requests of one address without a log-in": limits.REQUESTS_OF_ADDRESS,
        "messages of one page": limits.MESSAGES,
        "bytes a person sends": limits.UPLOADED,
        "searches of a person": limits.SEARCHES,
    }
    once = {
        "wrong tries in a row that lock an account": f"{limits.FAILED}, for {limits.LOCKED / 60:.0f} min",
        "a log-in ends after rest, and in any case": f"{limits.IDLE / 3600:.0f} h, {limits.LOGIN / 3600:.0f} h",
        "sessions a person keeps, bytes of their actions": f"{limits.SESSIONS}, {limits.DISK:,}",
        "members of a class": f"{limits.MEMBERS}",
    }
    lines = [
        "## Limits",
        "",
        "From `app/people/limits.py`, where each has its reason. All hold over every process of a server: tries, bytes",
        "and searches are counted in the database; requests by the one process that browsers come to; messages by the",
        "process that has the person's session, which is one at a time.",
        "",
        "| what | at most |",
        "|---|---|",
    ]
    lines += [f"| {what} | {limit.most:,} in {limit.seconds:g} s |" for what, limit in per.items()]
    lines += [f"| {what} | {most} |" for what, most in once.items()]
    return "\n".join(lines) + "\n"
