"""Somebody with an account, and what his names may be."""

from __future__ import annotations

import hashlib
import unicodedata
from dataclasses import dataclass
from typing import Literal, cast, get_args

from app.people.limits import LOGIN_NAME
from app.people.refusals import refused

Role = Literal["trainee", "trainer", "administrator"]
#: Characters taken of a name that somebody else vouches for: a number may still follow.
LONGEST_TRIED = LOGIN_NAME - 4
ROLES: tuple[Role, ...] = get_args(Role)


@dataclass(frozen=True)
class Person:
    """Somebody with an account.

    Args:
        id: nobody guesses it; stays when all else changes.
        owner: what his sessions, scores and files hang on; made from his id.
        login: what he types to come in.
        name: what others see.
        role: trainee, trainer or administrator.
        created: seconds since 1970.
        locked_until: seconds since 1970; before that no try counts.
        disabled: shut out; his work is kept.
    """

    id: str
    owner: str
    login: str
    name: str
    role: Role
    created: float
    locked_until: float
    disabled: bool


def owner_of_person(id: str) -> str:
    """The owner string of a person: as long as that of a browser, and no browser's secret makes it."""
    return hashlib.sha256(f"person {id}".encode()).hexdigest()


def folded(login: str) -> str:
    """A log-in name as it is compared: small letters, one form of each sign, no space around."""
    return unicodedata.normalize("NFKC", login).casefold().strip()


def fit_login(login: str) -> str:
    """A log-in name as it is kept; raises PersonRefusedError where it cannot be one."""
    login = folded(login)
    if not login or len(login) > LOGIN_NAME or not login.isprintable() or " " in login:
        raise refused("login", most=LOGIN_NAME)
    return login


def fit_role(role: str) -> Role:
    """The role, where there is such a one; raises PersonRefusedError."""
    if role not in ROLES:
        raise refused("role", roles=", ".join(ROLES))
    return cast(Role, role)
