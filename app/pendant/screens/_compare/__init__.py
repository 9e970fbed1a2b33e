"""The Compare screen's parts.

loaded.py     a recording with its robot, what is known of it, and the search; no viser
ghost.py      joints that bring the ghost's tool to an exaggerated place; no viser
hidden.py     a recording from a simulated cell with a hidden fault
drawing.py    arm, ghost, arrows, colours, proposed poses in the cell
plots.py      the report's pictures inside a panel
cards.py      words: the recording, the row, the findings
"""
