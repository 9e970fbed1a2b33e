"""A class at work: what it has to do, how far everybody is, who needs help. No web in it.

tables.py       lessons, exercises made here, hints, presence: tables of the sessions' database
room.py         Room: the way to everything else here
assignments.py  lessons of a class: exercise, order, due time, helps
making.py       an exercise made in a page: fields -> file, mistakes as lines
made.py         exercises made here, kept; their files
progress.py     scores -> how somebody stands, and what is next
losses.py       scores of a lesson -> where points are lost
grades.py       tables for spreadsheets and learning platforms
working.py      what somebody does now: working, stuck, stopped, finished, away
presence.py     the same, kept, so that a page of any process shows it
hints.py        a trainer's words to a trainee, and whether he got them
"""

from app.classroom.room import Room

__all__ = ["Room"]
