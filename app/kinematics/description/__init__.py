"""A robot description, from the bytes of a file to the chain of joints that is the arm.

address.py    NAME|FILE with what was chosen in it: flange and chain
package.py    a folder or a zip: where in it the description is
reading.py    a robot's file, whatever its kind, as one checked description
xml.py        URDF as plain elements: no namespaces, no entities, bounded
xacro.py      macros expanded, within the file's own folder
checked.py    numbers, names and sizes looked at before any compiled library sees them
tree.py       links and joints as a tree
accessories.py  names of what is no arm: jaws, cameras, collision stubs, wheels
flange.py     which link tools are bolted to
arm.py        which joints are the arm, and what there is to choose from
plain.py      the arm alone as a small URDF, everything beside it fixed
dhtable.py    a table of Denavit-Hartenberg rows as a URDF
urcalibration.py  Universal Robots' calibration of one arm as a URDF
"""
