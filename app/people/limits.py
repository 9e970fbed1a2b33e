"""How much a person may do: every limit of the server, each with its unit and its reason."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Limit:
    """So many in so many seconds."""

    most: int
    seconds: float


#: Tries to log in under one name from one address: a person mistypes twice; a program that guesses gets 7200 a day.
TRIES = Limit(5, 60.0)
#: Tries from one address under any names: a class of 30 comes in by one router, each mistyping once.
TRIES_OF_ADDRESS = Limit(60, 60.0)
#: Wrong tries in a row, from anywhere, that lock an account: with the seconds below a PIN of six digits, guessed day
#: and night, lasts six years on average.
FAILED = 10
#: Seconds an account stays locked [s]: a person waits for it, or his trainer gives him another PIN.
LOCKED = 900.0
#: Seconds without a sign of life after which a log-in ends [s]: a lunch break; a shared computer is free again.
IDLE = 2 * 3600.0
#: Seconds after which a log-in ends in any case [s]: a working day.
LOGIN = 12 * 3600.0
#: Seconds between two notes that a log-in is alive [s]: a write a minute and person, not one a request.
TOUCH = 60.0
#: Hashes of secrets at once: each takes 64 MiB and 0.19 s of a core; the other cores are left to who works.
HASHES = 1
#: People who wait for theirs: a class of 30 is in after 6 s; who comes when so many wait is asked to come again.
WAITING = 60

#: Shortest and longest password, and PIN, in characters. A password so long is no sentence any more, it is a file.
PASSWORD = (10, 200)
PIN = (6, 12)
#: Characters of a name and of a log-in name.
NAME, LOGIN_NAME = 80, 80
#: Members of a class: a lecture hall.
MEMBERS = 1000

#: Largest form [bytes]: a few lines.
FORM = 8192
#: Messages of one page; what comes faster waits in its own socket. A page says 30 beats a second while a key is held.
MESSAGES = Limit(300, 1.0)

#: Requests of one log-in: a page takes 15, a folder of 2000 files that is dropped one each.
REQUESTS = Limit(2000, 10.0)
#: Requests of one address without a log-in: the log-in page takes 4; a class of 60 opens it at once and types.
REQUESTS_OF_ADDRESS = Limit(400, 10.0)
#: Bytes a person may send: ten of the largest files an hour.
UPLOADED = Limit(4_000_000_000, 3600.0)
#: Drops of files that are on their way at once: each may fill the disk with its largest file.
DROPS = 2
#: Searches for what is missing: each takes a core for seconds to minutes.
SEARCHES = Limit(30, 600.0)
#: Sessions of a person, and bytes of their actions: a day of work is about a megabyte.
SESSIONS, DISK = 200, 500_000_000
#: Arms a person brings by their own descriptions, and bytes of each as it is kept: six axes with the makers' meshes,
#: made light, are about one megabyte.
ARMS, ARM = 12, 8_000_000
