"""How good a tool frame is, said so that it can be trusted.

region.py          the region that holds the true tool point in 95 of 100 cases
leave_one_out.py   what each touch alone does to the result, and how well the others predict it
rounding.py        what the written digits can do to the result
references.py      the gap to a tool stated elsewhere, and what explains it
light.py           green, yellow, red: with the reason and the next action
"""
