"""What a session may ask about all sessions: list the owner's, open another one, keep scores."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from app.classroom.progress import Lesson
from app.people import Person
from app.people.limits import DISK, SEARCHES, SESSIONS
from app.people.tries import Tries
from app.session import Store
from app.session.arms import Arms
from app.session.owners import Owners
from app.session.store import Listed
from app.training.records import Records


@dataclass(frozen=True)
class Shelf:
    """The sessions of one person.

    Args:
        store: where they are kept.
        owners: whose they are.
        records: scores of exercises.
        arms: what people brought by their own descriptions.
        owner: the person.
        in_use: True where a page shows this session now.
        switch: hands the person's page another session; returns at once.
        person: who he is, on a server with accounts; what belongs to nobody is then nobody's.
        lessons: what his classes have given him to do, in order.
    """

    store: Store
    owners: Owners
    records: Records
    arms: Arms
    owner: str
    in_use: Callable[[str], bool]
    switch: Callable[[str], None]
    person: Person | None = None
    lessons: Callable[[], Sequence[Lesson]] = tuple

    def mine(self, most: int) -> list[tuple[Listed, str]]:
        """The person's sessions with their names, the newest first; and those that belong to nobody."""
        titles = self.owners.titles(self.owner)
        listed = self.store.list(most, titles.keys() | self._nobodys())
        return [(session, titles.get(session.name, "")) for session in listed]

    def may(self, name: str) -> bool:
        """True where the person may open, export, rename or delete a session."""
        return name in self.owners.titles(self.owner) or name in self._nobodys()

    def full(self) -> bool:
        """True where the person keeps as much as one person may."""
        sessions, size = self.owners.used(self.owner)
        return sessions >= SESSIONS or size >= DISK

    def may_search(self) -> bool:
        """Counts one more search; False where there were too many lately."""
        return Tries(self.store.database).count(SEARCHES, "search", self.owner)

    def _nobodys(self) -> set[str]:
        """Kept by a version that knew no owners: whoever is alone with his machine takes it over."""
        return self.owners.nobodys() if self.person is None else set()
