"""What `teachframe people`, `teachframe class` and `teachframe audit` do, a file a command.

base.py      where accounts are kept; secrets, which are typed or come on stdin, and are never an argument
listing.py   a list as a table or as JSON
people_*.py  add, list, role, reset, remove, export, erase
class_*.py   make, list, members, code, put, take out, trainer, delete
"""
