"""Recordings of where a tool point is: touches and tracker points.

cell.py     what stands in the cell, and what deviates from the description
poses.py    joint positions that a sensible person would choose
making.py   draws a cell, puts the effects in and measures
"""
