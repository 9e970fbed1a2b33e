"""What somebody did at the pendant: a frozen state, actions on it, and a journal that is the truth.

    actions.py    everything that can be done, as data
    state.py      SessionState: robot, joints, captures, result, tools
    refusals.py   why an action was not done
    steps/        one file a family of actions: (state, action) -> state
    reducer.py    sends an action to its family; undo and redo
    points.py     a points file as one action
    journal.py    a journal as a file: one JSON line an action
    session.py    Session: the state that moves, with its journal behind it
    database.py   SQLite, or any other database by URL: an action is on the disk before it counts
    store.py      all sessions, a row an action
    arms.py       arms that people brought by their own descriptions
    owners.py     whose a session is, and what it is called
    cell.py       the practice cell as the session says
    motion/       the arm's drive: enabling, jog, watchdog, stop
    report.py     what a replay prints

The browser, the command line, the replay and the tests all speak actions, so a whole wizard runs without a
browser, and a journal gives the same result again.
"""

from app.session.actions import AnyAction
from app.session.reducer import reduce
from app.session.session import Session, replay
from app.session.state import SessionState
from app.session.store import Store

__all__ = ["AnyAction", "Session", "SessionState", "Store", "reduce", "replay"]
