"""The cell somebody works in, as wrong as a real one: what is true, and what the controller shows of it.

world.py      an arm with its true tool, a spike on a table, and a hand that touches it with noise
faults.py     what is wrong with the arm: effects of the diagnosis' library, applied exactly
tracker.py    a laser tracker; tracker_cell.py two arms around it, tracker_procedure.py and tracker_meeting.py on it
"""
