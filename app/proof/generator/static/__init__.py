"""Recordings of where a tool point is: touches and tracker points.

cell.py     what stands in the cell, and what deviates from the description
poses.py    joint positions that a sensible person would choose
plan.py     how a recording is made; setting.py draws the cell, visits.py in which order poses are visited
making.py   draws a cell, puts the effects in and measures
members.py  deviations of an arm that is off everywhere; whole.py records it twice and says what is true of it
linear.py   what small changes do to the readings, by levers
"""
