"""What stands in the cell, one file a thing; the only package that imports viser. Positions in metres, in base.

server.py      one viser server a session, without a port; pages.py how it gets to its pages
client_page.py viser's client as one page without its panels
stage.py       everything of the usual cell, and what of it is seen
arm.py         an arm: nested frames, a turn a joint
eyes.py        where the pages look from; camera.py the named places
ground.py      floor, light, background
cell.py        table, spike and fence
handle.py      the drag handle at the tool point
held_tool.py   the tool in the arm's hand
marks.py       recorded flange poses as small frames
residuals.py   what each touch missed, as arrows
tool_axes.py   the tool frame that was found, on the tool
user_axes.py   the user frame
region.py      how well it is known: ellipsoid of its point, cones of its axes
trace.py       the way of the true tip while the tool turns about its point
next_arm.py    the arm as it would stand at the next touch, translucent
tracker_cell.py  two robots and a laser tracker
exaggeration.py  by how much small things are drawn larger
"""

from __future__ import annotations

import viser

#: What a screen draws in, and what it gets back.
Scene = viser.SceneApi
Node = viser.SceneNodeHandle

__all__ = ["Node", "Scene"]
