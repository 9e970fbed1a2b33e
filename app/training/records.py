"""All scores, in the sessions' database: the history of a trainee from try to try."""

from __future__ import annotations

from collections.abc import Collection, Iterable

import msgspec
from sqlalchemy import Column, Float, Integer, String, Table, Text, insert, select

from app.errors import FileFormatError
from app.session.database import METADATA, Database
from app.training.score import ScoreCard
from app.typed import learnt

_CARD = learnt(ScoreCard)
SCORES = Table(
    "scores",
    METADATA,
    Column("id", Integer, primary_key=True, autoincrement=True),
    Column("trainee", String(80), nullable=False, index=True),
    Column("session", String(32), nullable=False),
    Column("exercise", String(80), nullable=False),
    Column("begun", Float, nullable=False),
    Column("total", Float, nullable=False),
    Column("card", Text, nullable=False),
)


class Records:
    """The scores in a database.

    Args:
        database: the store's.
    """

    def __init__(self, database: Database):
        self._database = database

    def add(self, trainee: str, session: str, card: ScoreCard) -> None:
        """Keeps one score; raises StorageError."""
        row = {
            "trainee": trainee,
            "session": session,
            "exercise": card.exercise,
            "begun": card.begun,
            "total": card.total,
            "card": msgspec.json.encode(card).decode(),
        }
        with self._database.begin() as connection:
            connection.execute(insert(SCORES), row)

    def has(self, session: str, begun: float) -> bool:
        """True where the attempt that began in this session at that time has its score."""
        kept = select(SCORES.c.id).where(SCORES.c.session == session, SCORES.c.begun == begun)
        with self._database.begin() as connection:
            return connection.execute(kept).first() is not None

    def history(self, trainee: str, exercise: str | None = None) -> list[ScoreCard]:
        """What a trainee reached, the oldest first; of one exercise, or of all.

        Raises:
            FileFormatError: a row cannot be read.
        """
        wanted = select(SCORES.c.id, SCORES.c.card).where(SCORES.c.trainee == trainee).order_by(SCORES.c.id)
        if exercise is not None:
            wanted = wanted.where(SCORES.c.exercise == exercise)
        with self._database.begin() as connection:
            rows = connection.execute(wanted).all()
        return [_card(number, text) for number, text in rows]

    def histories(self, trainees: Collection[str], exercise: str | None = None) -> dict[str, list[ScoreCard]]:
        """What many trainees reached, the oldest first each; who has no score is not there.

        Raises:
            FileFormatError: a row cannot be read.
        """
        wanted = (
            select(SCORES.c.trainee, SCORES.c.id, SCORES.c.card)
            .where(SCORES.c.trainee.in_(list(trainees)))
            .order_by(SCORES.c.id)
        )
        if exercise is not None:
            wanted = wanted.where(SCORES.c.exercise == exercise)
        with self._database.begin() as connection:
            rows = connection.execute(wanted).all()
        found: dict[str, list[ScoreCard]] = {}
        for trainee, number, text in rows:
            found.setdefault(trainee, []).append(_card(number, text))
        return found

    def trainee_of(self, session: str) -> str:
        """Who did the last exercise in a session; empty where nobody did."""
        newest = (
            select(SCORES.c.trainee).where(SCORES.c.session == session).order_by(SCORES.c.id.desc()).limit(1)
        )
        with self._database.begin() as connection:
            return connection.execute(newest).scalar() or ""


def best_of(history: Iterable[ScoreCard]) -> dict[str, float]:
    """The best total of each exercise a trainee has done."""
    found: dict[str, float] = {}
    for card in history:
        if not card.given_up:
            found[card.exercise] = max(found.get(card.exercise, 0.0), card.total)
    return found


def _card(number: int, text: str) -> ScoreCard:
    try:
        return _CARD.decode(text)
    except msgspec.DecodeError as error:
        raise FileFormatError(f"not a score ({error})", file="scores", row=number) from None
