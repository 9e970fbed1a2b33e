"""Passwords and PINs: kept as argon2id writes them, with the library's own costs (RFC 9106, 64 MiB), but on one
core: however many come at once, the others are left to who works."""

from __future__ import annotations

import itertools
import threading

from argon2 import PasswordHasher
from argon2.exceptions import InvalidHashError, VerificationError

from app.people.limits import HASHES, PASSWORD, PIN
from app.people.refusals import refused

_HASHER = PasswordHasher(parallelism=1)
_AT_ONCE = threading.BoundedSemaphore(HASHES)
#: Compared with where there is no such person: an answer then takes as long as one to a wrong password.
_NOBODY = "$argon2id$v=19$m=65536,t=3,p=1$CgnOFMdUZ9waeBrDmSzH+Q$x5v7xGtGNKb7ZUUycJlBOzDMryHLUiUfY6ZnLruQASg"


def hashed(secret: str) -> str:
    """What is kept of a secret; takes 0.19 s of a core."""
    with _AT_ONCE:
        return _HASHER.hash(secret)


def matches(kept: str, secret: str) -> bool:
    """True where `kept` was made of this secret; takes the same time where `kept` is empty."""
    with _AT_ONCE:
        try:
            return _HASHER.verify(kept or _NOBODY, secret[: PASSWORD[1]]) and bool(kept)
        except (VerificationError, InvalidHashError):
            return False


def outdated(kept: str) -> bool:
    """True where the library would hash at another cost today."""
    return _HASHER.check_needs_rehash(kept)


def fit_password(secret: str) -> str:
    """The password, where it can be one; raises PersonRefusedError."""
    least, most = PASSWORD
    if not least <= len(secret) <= most or len(set(secret)) < 4:
        raise refused("password", least=least, most=most)
    return secret


def fit_pin(secret: str) -> str:
    """The PIN, where it can be one: digits, neither all the same nor counting up or down; raises PersonRefusedError."""
    least, most = PIN
    steps = {int(b) - int(a) for a, b in itertools.pairwise(secret)} if _digits(secret) else {0}
    if not least <= len(secret) <= most or steps in ({0}, {1}, {-1}):
        raise refused("pin", least=least, most=most)
    return secret


def _digits(text: str) -> bool:
    return text.isascii() and text.isdigit()
