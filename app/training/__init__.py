"""Exercises: what a trainee is to do in a cell whose truth nobody tells, and a score against that truth.

    exercise.py   Exercise: a file under static/exercises
    truth.py      what is hidden in one attempt, drawn from its seed
    cell.py       the cell somebody works in while an exercise is done
    tracker.py    the same for two robots around a laser tracker
    attempt.py    the actions of one attempt, taken out of a session's journal
    travel.py     way, closest approach, contacts
    score.py      (exercise, journal with times) -> ScoreCard: pure, so a score is computed again at any time
    levels.py     the same task with fewer helps each time, and what that is worth
    weighing.py   a payload found by moving the arm: its log, and the search in it
    advice.py     what to do better next
    records.py    all scores, in the sessions' database

What the browser never receives before the end: the seed, the true tool point and axes, the true place of the spike,
faults (which, where, how large), the wrong tool's being wrong. What it does receive: a drawing whose tip and spike
stand 0.8 mm beside the true ones in directions drawn with the truth (`simulation.world.Picture`), so the drawing tells
less than careful touches do; what the exercise's aids show to everybody (a distance in tenths of a millimetre, the
light at contact); and joint positions of touches the program made, each with the touch noise in it.
"""
