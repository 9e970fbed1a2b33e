"""The parts of the tool screen.

rows.py        the list: a row a point
hand.py        what the program does for a careful hand: touch, stroke
leading.py     which key is pressed next, and stands out
next_touch.py  before a capture: what it would bring, and the best one as a ghost arm
direct.py      the fields of direct entry
deciding.py    the result: accepted or cancelled, exported
result.py      a calibration as a piece of page
verifying.py   the turn about the accepted tool point, with the trace of the true tip
giving.py      export, report, and tool frames from files
paper.py       points from a file, shown
words.py       modes and steps in a maker's words and the operator's language
"""
