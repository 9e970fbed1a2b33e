"""The cell somebody works in, as wrong as a real one: what is true, and what the controller shows of it.

world.py      an arm with its true tool, a spike on a table, and a hand that touches it with noise
"""
