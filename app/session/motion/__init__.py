"""How the arm of one session moves: only while somebody holds the enabling switch, and no faster than T1 allows.

    worker.py     one thread a session: jobs in order, motions tick by tick beside them
    enabling.py   the enabling switch: held, watched, tripped by silence; the emergency stop
    pace.py       how long a way takes: 250 mm/s at the tool point, and a limit a joint
    drive.py      where the arm stands, and how it gets elsewhere
    jogging.py    hold to move; jog_way.py the way of one jog
    following.py  the arm follows the drag handle
    guarding.py   what keeps it from hitting anything
    user_frame.py the frame that is typed or taught
    trail.py      the way it went, kept while an exercise runs

Nothing here knows a browser, a scene or a web server: what is said goes to a `Voice`, what is seen to one callback.
"""
