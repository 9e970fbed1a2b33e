"""The parts of the tool screen.

rows.py      the list: a row a point
hand.py      what the program does for a careful hand: touch, stroke, the proposed touch, the check turn
result.py    a calibration as a piece of page
paper.py     points from a file, shown
words.py     modes and steps in a maker's words and the operator's language
"""
