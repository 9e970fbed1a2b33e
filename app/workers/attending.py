"""Looks once a second at every open session of somebody in a class: what he does is kept, hints are brought to him."""

from __future__ import annotations

import logging
import math
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

from app.classroom import Room
from app.classroom.presence import FRESH, Presence
from app.classroom.working import Glance, Watch
from app.errors import TeachframeError
from app.session.actions import Finish
from app.workers.live import Live

_LOG = logging.getLogger(__name__)
EVERY = 1.0  # seconds between two looks: a hint arrives within it
#: Seconds for which it is remembered who is in a class: who joins is seen after it.
_MEMBERS = 5.0


@dataclass
class _Seen:
    """One session as it was seen last."""

    watch: Watch = field(default_factory=Watch)
    count: int = 0  # actions
    kept: Presence | None = None


class Attending:
    """Looks, on a thread of its own, from `start` to `stop`.

    Args:
        room: the classes.
        lives: all open sessions of this process.
        shown: True where a page shows one of them.
    """

    def __init__(self, room: Room, lives: Callable[[], Sequence[Live]], shown: Callable[[Live], bool]):
        self._room, self._lives, self._shown = room, lives, shown
        self._seen: dict[str, _Seen] = {}  # by session
        self._enrolled: tuple[float, frozenset[str]] = (-math.inf, frozenset())
        self._wake, self._ended = threading.Event(), False
        self._thread = threading.Thread(target=self._run, name="attending", daemon=True)

    def start(self) -> None:
        """Begins to look."""
        self._thread.start()

    def stop(self) -> None:
        """Looks no more."""
        self._ended = True
        self._wake.set()
        if self._thread.is_alive():
            self._thread.join(timeout=2.0)

    def nudge(self) -> None:
        """Looks now: a hint was sent."""
        self._enrolled = (-math.inf, frozenset())
        self._wake.set()

    def look(self, now: float | None = None) -> None:
        """One look at everybody.

        Args:
            now: seconds that only grow; None asks the clock.
        """
        now = time.monotonic() if now is None else now
        enrolled = self._members(now)
        lives = {
            live.context.shelf.owner: live
            for live in self._lives()
            if live.context.shelf.owner in enrolled and not live.closed
        }
        names = {live.session.name for live in lives.values()}
        self._seen = {name: seen for name, seen in self._seen.items() if name in names}
        if not lives:
            return
        at = time.time()
        news = [
            one for owner, live in lives.items() if (one := self._safely(owner, live, now, at)) is not None
        ]
        self._room.presences.keep(news)
        for one in news:
            self._seen[one.session].kept = one
        hints = self._room.hints.waiting(list(lives))
        for owner, live in lives.items():
            live.hints.bring([hint for hint in hints if hint.owner == owner])

    def _safely(self, owner: str, live: Live, now: float, at: float) -> Presence | None:
        """One look; an arm that is exchanged in this very moment is looked at the next time."""
        try:
            return self._look(owner, live, now, at)
        except (ValueError, IndexError) as error:
            _LOG.debug("a look at %s failed: %s", live.session.name, error)
            return None

    def _look(self, owner: str, live: Live, now: float, at: float) -> Presence | None:
        """What is to be kept of somebody; None where what is kept still holds."""
        seen = self._seen.setdefault(live.session.name, _Seen())
        glance = _glance(live, seen.count, self._shown(live), now)
        seen.count += len(glance.new)
        state = seen.watch.see(glance)
        done, points = _points(live)
        one = Presence(
            owner,
            live.session.name,
            state,
            at - (now - seen.watch.since),
            at,
            glance.exercise,
            done,
            points,
        )
        before = seen.kept
        same = before is not None and replace(before, since=one.since, at=one.at) == one
        return None if same and before is not None and at - before.at < FRESH else one

    def _members(self, now: float) -> frozenset[str]:
        """Owner strings of everybody who is in a class."""
        asked, owners = self._enrolled
        if now - asked >= _MEMBERS:
            owners = self._room.enrolled()
            self._enrolled = (now, owners)
        return owners

    def _run(self) -> None:
        while not self._ended:
            try:
                self.look()
            except TeachframeError as error:  # the database is busy, or away: the next look may find it again
                _LOG.warning("who works at what was not kept: %s", error)
            except Exception:
                _LOG.exception("a look at the class failed")
            self._wake.wait(EVERY)
            self._wake.clear()


def _glance(live: Live, count: int, page: bool, now: float) -> Glance:
    context, state = live.context, live.session.state
    flange = context.model.forward(context.q)
    missing = state.missing
    new = live.session.since(count)
    ended = live.session.ended
    return Glance(
        at=now,
        page=page,
        stopped=context.drive.enabling.stopped,
        exercise=state.running.begun.exercise if state.running is not None else "",
        finished=ended is not None and isinstance(ended, Finish),
        new=tuple(entry.action for entry in new),
        distance=context.world.distance(context.q),
        rotation=flange.rotation,
        position=flange.position,
        stroke=bool(missing) and "touch" not in missing[0].roles,
    )


def _points(live: Live) -> tuple[int, int]:
    """Points recorded, of so many."""
    state = live.session.state
    if state.running is not None and state.running.wizard is not None:
        return state.running.wizard.index, len(state.running.wizard.steps)
    return len(state.steps) - len(state.missing), len(state.steps)
