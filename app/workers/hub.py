"""Who has which session open: one page a session, handed back after a reload, forgotten some time after it has gone."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from weakref import WeakValueDictionary

from app.apart import prepare
from app.classroom import Room
from app.classroom.progress import Lesson
from app.errors import StorageError, TeachframeError
from app.kinematics import RobotModel, load_robot
from app.people import Person
from app.screens.look import Look
from app.screens.shelf import Shelf
from app.session import Session, Store
from app.session.arms import Arms
from app.session.leases import BEAT, Leases
from app.session.owners import Owners
from app.simulation.world import World, default_world
from app.workers.attending import Attending
from app.workers.idle import Idle
from app.workers.live import Live

_LOG = logging.getLogger(__name__)
LINGER = 60.0  # seconds a session stays open after its page has gone: a reload finds everything as it was
#: What a process that reads somebody's file needs; loaded once, before the first file.
READERS = (
    "app.screens._compare.jobs",
    "app.screens._sessions.replaying",
    "app.screens._cell.bringing",
    "app.calibration.exchange",
    "app.session.points",
)


class Hub:
    """All open sessions of one server.

    Args:
        store: where sessions are kept.
        robot: arm of new sessions; None takes the usual one.
        usual_world: the cell of an arm.
        linger: seconds a session stays open without a page.
        unvisited: seconds a session that was just opened waits for its first page; None waits for ever.
    """

    def __init__(
        self,
        store: Store,
        *,
        robot: str | None = None,
        usual_world: Callable[[RobotModel], World] = default_world,
        linger: float = LINGER,
        unvisited: float | None = None,
    ):
        if robot is not None:
            load_robot(robot)
        prepare(READERS)
        self.store, self.owners, self.arms = store, Owners(store.database), Arms(store.database)
        self.room = Room(store.database)
        self.records = self.room.records
        self._robot, self._usual_world, self._linger = robot, usual_world, linger
        self._unvisited = unvisited
        self._lock = threading.RLock()
        self._live: dict[str, Live] = {}  # by session
        self._at: dict[str, str] = {}  # owner -> session that is open for him
        self._people: dict[str, Person | None] = {}  # owner -> who he is
        self._pages: dict[str, object] = {}  # session -> the page that shows it
        self._idle = Idle(lambda name: self._forget(name, idle=True))
        self._doors: WeakValueDictionary[str, threading.Lock] = WeakValueDictionary()  # by owner
        self._closed = False
        self.attending = Attending(
            self.room, lambda: self.lives, lambda live: live.session.name in self._pages
        )
        self._leases = Leases(store.database)
        self._ending = threading.Event()
        threading.Thread(target=self._beat, name="leases", daemon=True).start()

    def enter(self, owner: str, look: str | None = None, person: Person | None = None) -> Live:
        """The open session of this person: the one he had last, or a new one. Takes a moment the first time.

        Args:
            owner: what his sessions hang on.
            look: how his browser's cookie says the page shall look and speak.
            person: who he is, on a server with accounts.
        """
        live = self.find(owner)
        if live is not None:
            return live
        # One at a time for each person. Others wait for neither his disk nor his lease: after a process was killed
        # all of its people come at once.
        with self._door(owner):
            if self._closed:
                raise RuntimeError("the server is stopping")
            live = self.find(owner)
            if live is not None:
                return live
            name = self.owners.latest(owner)
            with self._kept(name):
                session, how = self._session(owner, name)
                with self._lock:
                    self._people[owner] = person
                live = self._open(session, owner, Look.from_cookie(look), expected=how == "back")
            live.greet(how)
            return live

    def find(self, owner: str) -> Live | None:
        """The open session of this person, where one is open."""
        return self._live.get(self._at.get(owner, ""))

    def elsewhere(self, owner: str) -> int | None:
        """The other process of this machine that has this person's session open, where one has."""
        name = self.owners.latest(owner)
        return None if name is None else self._leases.process(name)

    def leave(self, owner: str) -> None:
        """Closes what this person has open."""
        live = self.find(owner)
        if live is not None:
            self._forget(live.session.name)

    def arrive(self, live: Live, page: object) -> None:
        """A page shows the session from now on; the one before lets go. One that was closed meanwhile shows nothing."""
        with self._lock:
            name = live.session.name
            if self._live.get(name) is live:
                self._pages[name] = page
                self._idle.end(name)
                live.let_go()

    def shows(self, live: Live, page: object) -> bool:
        """True while this page is the one that shows the session."""
        return self._pages.get(live.session.name) is page

    def depart(self, live: Live, page: object) -> None:
        """A page has gone: the arm stands; the session is closed after a while, where nobody comes back."""
        name = live.session.name
        with self._lock:
            if self._pages.get(name) is not page:
                return
            del self._pages[name]
            live.let_go()
            if name not in self._live or self._closed:
                return
            self._idle.begin(name, self._linger)

    def in_use(self, name: str) -> bool:
        """True where a page shows this session now."""
        return name in self._live

    @property
    def lives(self) -> list[Live]:
        """All open sessions."""
        with self._lock:
            return list(self._live.values())

    def close(self) -> None:
        """Closes every session."""
        self.attending.stop()
        with self._lock:
            self._closed = True
            lives, self._live = list(self._live.values()), {}
            self._idle.stop()
        self._ending.set()
        for live in lives:
            live.close()
            self._leases.let(live.session.name)

    def _door(self, owner: str) -> threading.Lock:
        """Held by whoever opens or closes a session of this person."""
        with self._lock:
            return self._doors.setdefault(owner, threading.Lock())

    def _session(self, owner: str, name: str | None) -> tuple[Session, str]:
        how = "new"
        self.arms.grant(owner)
        if name is not None:
            self._leases.take(name)  # may take seconds
        if name is not None and self.store.has(name):
            try:
                return self.store.open(name, leases=self._leases), "back"  # the one opened last still is
            except StorageError:
                raise  # it may be read in a moment: it is not lost
            except TeachframeError:
                how = "lost"
        session = self.store.create(robot=self._robot, leases=self._leases)
        self.owners.give(session.name, owner)
        return session, how

    def _open(self, session: Session, owner: str, look: Look, *, expected: bool) -> Live:
        person = self._people.get(owner)
        shelf = Shelf(
            self.store,
            self.owners,
            self.records,
            self.arms,
            owner,
            self.in_use,
            lambda name: self._switch(owner, name),
            person,
            tuple if person is None else lambda: self._lessons(person.id),
        )
        live = Live(session, shelf, self._usual_world, look, self.room.hints)
        with self._lock:
            if not self._closed:
                self._live[session.name] = live
                self._at[owner] = session.name
                # Who asks for the page and never comes in keeps no session open.
                self._idle.begin(session.name, self._unvisited, expected=expected)
                return live
        live.close()
        self._leases.let(session.name)
        raise RuntimeError("the server is stopping")

    def _lessons(self, person: str) -> list[Lesson]:
        return [lesson for _, lessons in self.room.lessons_of(person) for lesson in lessons]

    def _switch(self, owner: str, name: str) -> None:
        """The person's page goes on with another session, opened on a thread of its own: the worker that asked for it
        ends with the session before."""
        threading.Thread(target=self._switched, args=(owner, name), daemon=True).start()

    def _switched(self, owner: str, name: str) -> None:
        try:
            with self._door(owner):
                before = self.find(owner)
                if self._closed or name in self._live:
                    return
                self._change(before, owner, name)
        except TeachframeError as error:
            _LOG.warning("session %s was not opened: %s", name, error)
            return
        if before is not None:
            self._forget(before.session.name)

    def _change(self, before: Live | None, owner: str, name: str) -> None:
        look = Look() if before is None else replace(before.context.look)
        with self._kept(name):
            self._leases.take(name)  # may take seconds
            self.arms.grant(owner)
            session = self.store.open(name, leases=self._leases)
            if name in self.owners.titles(owner):
                self.owners.opened(name)
            else:
                self.owners.give(name, owner)
            live = self._open(session, owner, look, expected=True)
        live.greet("back")

    @contextmanager
    def _kept(self, name: str | None) -> Iterator[None]:
        """What is not open after it is not held either: else no other process could ever open it."""
        try:
            yield
        finally:
            if name is not None and name not in self._live:
                self._leases.let(name)

    def _forget(self, name: str, *, idle: bool = False) -> None:
        """Closes a session; with `idle` only where no page shows it."""
        live = self._live.get(name)
        if live is None:
            return
        owner = live.context.shelf.owner
        # Who comes back meanwhile waits: he would read what is still being written.
        with self._door(owner):
            with self._lock:
                if self._live.get(name) is not live or (idle and name in self._pages):
                    return
                live.closed = True  # its page is told so, and comes again
                del self._live[name]
                self._idle.end(name)
                self._pages.pop(name, None)
                if self._at.get(owner) == name:
                    del self._at[owner], self._people[owner]
            live.close()
            self._leases.let(name)

    def _beat(self) -> None:
        """Says every second what is held here, and lets go of what is wanted elsewhere or was lost."""
        while not self._ending.wait(BEAT):
            with self._lock:
                names = set(self._live)
            if not names:
                continue
            try:
                held, wanted = self._leases.beat()
            except StorageError:
                continue  # nobody else can take them either
            for name in (names - held) | (names & wanted):
                live = self._live.get(name)
                if live is not None and not live.taken:
                    live.taken = True
                    # Not here: the others' beats would wait, and theirs be taken for nobody's.
                    threading.Thread(target=self._forget, args=(name,), daemon=True).start()
