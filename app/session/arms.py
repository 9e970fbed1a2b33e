"""Arms that people brought by their own descriptions: kept with their sessions, unpacked where a process needs them.

A session names such an arm by its title and the hash of its description, so a name means the same arm wherever the
session goes. The packed description stands in the database, in pieces: a backup, another process and another machine
have it, and who is erased takes it along.
"""

from __future__ import annotations

import hashlib
import shutil
import tempfile
import threading
import time
import weakref
from dataclasses import dataclass, replace
from pathlib import Path

from sqlalchemy import Column, Float, Integer, LargeBinary, String, Table, Text, delete, func, insert, select

from app.errors import FileFormatError, UnknownNameError
from app.kinematics import RobotModel, load_robot
from app.kinematics.description.address import address_of
from app.kinematics.description.package import description_in, unpacked
from app.session.database import ACTIONS, METADATA, Database
from app.session.owners import OWNED
from app.session.state import grant_robot

ARMS = Table(
    "arms",
    METADATA,
    Column("owner", String(64), primary_key=True),
    Column("name", String(64), primary_key=True),
    Column("title", String(120), nullable=False),
    Column("chain", Text, nullable=False),  # BASE..TIP
    Column("size", Integer, nullable=False),  # bytes of all pieces
    Column("brought", Float, nullable=False),  # seconds since 1970
)
PIECES = Table(
    "arm_pieces",
    METADATA,
    Column("owner", String(64), primary_key=True),
    Column("name", String(64), primary_key=True),
    Column("n", Integer, primary_key=True, autoincrement=False),
    Column("piece", LargeBinary, nullable=False),
)
_PIECE = 65_536  # bytes: a backup holds a thousand rows at a time
_HASH = 16  # hexadecimal digits in a name


@dataclass(frozen=True)
class Packed:
    """An arm as it is kept.

    Args:
        title: what it is called.
        chain: its ends in the description, BASE..TIP.
        content: the zip that `app.kinematics.packing` made.
        said: what the person is told of it, such as meshes that are missing.
    """

    title: str
    chain: str
    content: bytes
    said: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """What a session calls it."""
        digest = hashlib.sha256(self.chain.encode() + b"\0" + self.content).hexdigest()[:_HASH]
        return f"{self.title}~{digest}"


def unpacked_arm(arm: Packed, folder: Path) -> str:
    """What loads an arm, unpacked below a folder.

    Raises:
        FileFormatError: its zip cannot be read.
    """
    packed = folder / f"{arm.name}.zip"
    packed.write_bytes(arm.content)
    try:
        return str(address_of(str(description_in(unpacked(packed, folder))), chain=arm.chain))
    finally:
        packed.unlink()


class _Unpacked:
    """The folder of unpacked arms; it is there as long as somebody holds it. A model that was read from it does: its
    meshes are opened when it is first drawn."""

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix="teachframe-arms-"))
        weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)


class Arms:
    """The arms of a database.

    Args:
        database: the store's.
    """

    def __init__(self, database: Database):
        self._database = database
        self._unpacked = _Unpacked()
        self._lock = threading.Lock()
        self._places: dict[str, tuple[str, str]] = {}  # name -> address, title

    def of(self, owner: str) -> dict[str, str]:
        """Name -> title of a person's arms, the oldest first."""
        mine = select(ARMS.c.name, ARMS.c.title).where(ARMS.c.owner == owner)
        with self._database.begin() as connection:
            rows = connection.execute(mine.order_by(ARMS.c.brought, ARMS.c.name)).all()
        return {row.name: row.title for row in rows}

    def keep(self, owner: str, arm: Packed) -> str:
        """Keeps an arm for a person; the name by which his sessions may use it from now on."""
        key = {"owner": owner, "name": arm.name}
        row = {"title": arm.title, "chain": arm.chain, "size": len(arm.content), "brought": time.time()}
        pieces = [
            {**key, "n": n, "piece": arm.content[at : at + _PIECE]}
            for n, at in enumerate(range(0, len(arm.content), _PIECE))
        ]
        with self._database.begin() as connection:
            self._take_away(connection, **key)
            connection.execute(insert(ARMS), {**key, **row})
            connection.execute(insert(PIECES), pieces)
        self.grant(owner)
        return arm.name

    def delete(self, owner: str, name: str) -> None:
        """Takes an arm away from a person; one that is not there is no error."""
        with self._database.begin() as connection:
            self._take_away(connection, owner, name)

    def used(self, owner: str, name: str) -> int:
        """How many sessions of a person name an arm."""
        named = ACTIONS.c.action.contains(f'"robot":"{name}"', autoescape=True)
        count = select(func.count(ACTIONS.c.session.distinct())).join(
            OWNED, OWNED.c.session == ACTIONS.c.session
        )
        with self._database.begin() as connection:
            return int(connection.execute(count.where(OWNED.c.owner == owner, named)).scalar_one())

    def grant(self, owner: str | None = None) -> None:
        """Sessions of this process may use a person's arms; None grants all that are kept here."""
        asked = select(ARMS.c.name).distinct()
        with self._database.begin() as connection:
            names = connection.scalars(asked if owner is None else asked.where(ARMS.c.owner == owner)).all()
        for name in names:
            grant_robot(name, self.model)

    def addresses(self, owner: str) -> dict[str, str]:
        """Name -> what loads a person's arm in another process of this machine."""
        return {name: self._place(name)[0] for name in self.of(owner)}

    def model(self, name: str) -> RobotModel:
        """The arm of that name.

        Raises:
            UnknownNameError: nobody keeps it here.
            FileFormatError: what is kept is damaged.
        """
        address, title = self._place(name)
        robot = replace(load_robot(address), name=title)
        robot.kept["unpacked"] = self._unpacked
        return robot

    def _place(self, name: str) -> tuple[str, str]:
        """Address and title of an arm; unpacked once."""
        with self._lock:
            if name not in self._places:
                self._places[name] = self._unpack(name)
            return self._places[name]

    def _unpack(self, name: str) -> tuple[str, str]:
        one = select(ARMS.c.owner, ARMS.c.title, ARMS.c.chain).where(ARMS.c.name == name).limit(1)
        with self._database.begin() as connection:
            row = connection.execute(one).first()
            if row is None:
                raise UnknownNameError(name[:80], available=(), what="robot")
            wanted = (PIECES.c.owner == row.owner, PIECES.c.name == name)
            pieces = connection.scalars(select(PIECES.c.piece).where(*wanted).order_by(PIECES.c.n)).all()
        arm = Packed(row.title, row.chain, b"".join(pieces))
        if arm.name != name:
            raise FileFormatError("what is kept of this robot is damaged", file=name)
        return unpacked_arm(arm, self._unpacked.path), arm.title

    @staticmethod
    def _take_away(connection, owner: str, name: str) -> None:
        for table in (ARMS, PIECES):
            connection.execute(delete(table).where(table.c.owner == owner, table.c.name == name))
