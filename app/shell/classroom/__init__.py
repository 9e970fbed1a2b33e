"""Pages of a class, beside the pendant: for its trainer, and for a trainee what is next.

front.py       what all of these pages share: who may, forms, answers, times
classes.py     a trainer's classes; a class: everybody, every lesson, what everybody does now
lessons.py     lessons of a class: assigned, ordered, with due times and helps
people.py      one trainee: how he stands, hints, copies of his sessions
watching.py    a trainee's arm live, read only
tables.py      scores and grades as files
exercises.py   exercises made here
mine.py        a trainee's own page
"""

from __future__ import annotations

from starlette.routing import BaseRoute

from app.shell.classroom.classes import Classes
from app.shell.classroom.exercises import Exercises
from app.shell.classroom.front import Front
from app.shell.classroom.lessons import Lessons
from app.shell.classroom.mine import Mine
from app.shell.classroom.people import People
from app.shell.classroom.tables import Tables
from app.shell.classroom.watching import Watching
from app.shell.entrance import Entrance
from app.workers.hub import Hub


def class_pages(entrance: Entrance, hub: Hub) -> list[BaseRoute]:
    """Routes of all pages of a class."""
    front = Front(entrance, hub)
    parts = (Classes, Lessons, People, Watching, Tables, Exercises, Mine)
    return [route for part in parts for route in part(front).routes]
