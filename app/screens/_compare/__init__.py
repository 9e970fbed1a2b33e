"""The Compare screen's parts.

loaded.py       a recording with its robot, what is known of it, and the search; no viser
ghost.py        joints that bring the ghost's tool to an exaggerated place; no viser
hidden.py       a recording from a simulated cell with a hidden fault, or with a saved model in it
kept.py         what outlives a reload of the page
sources.py      where a recording comes from
reading.py      a recording on its way in: how far it is, and the button that gives it up
jobs.py         what is done in a process of its own
given_model.py  a saved model that somebody brings
moments.py      which row is shown; a log plays
finding.py      the search: progress, stop
outcome.py      verdict, findings, the switch that puts them into the simulation
plotting.py     residual against drivers, torque over time
taking.py       report, model file, the practice cell
drawing.py      arm, ghost, arrows, colours, proposed poses in the cell
plots.py        the report's pictures inside a panel
cards.py        words: the recording, the row, the findings
"""
