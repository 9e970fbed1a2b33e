"""The pendant in the browser. The only package that imports viser.

server.py     the server: who connects gets a session, handed back after a reload
hub.py        which session belongs to which browser
client.py     Pendant: one browser's view of one session
inputs.py     what its widgets start
moving.py     where its arm stands, and how it gets elsewhere
aids.py       what it shows beyond what a real cell would
exercising.py what an exercise changes for a pendant; trail.py the way the arm went in it
shelf.py      what a pendant may ask of all sessions: list, open, scores
worker.py     one thread a session; callbacks only enqueue
motion.py     how the arm gets from pose to pose, tick by tick
layout.py     where things stand on the page: status line, message line, panels
arm.py        draws an arm
scene/        what stands in the cell, one file a thing
screens/      one file a screen, found by the catalogue
texts/        one file a language
html.py       small pieces of page
"""
