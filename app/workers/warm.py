"""What every session needs and can be had before there is one: modules, the usual arms, their shapes.

Imported for what it does, by the process that the workers of a server are forked from: a worker that takes the place of
one that died then costs its neighbours a tenth of a second of the processor and not two.
"""

from __future__ import annotations

from app.kinematics import robot_names
from app.scene.arm import shipped_meshes
from app.scene.client_page import client_page
from app.screens import screens
from app.session.state import first_state, robot_named

screens()
client_page()
for _name in robot_names():
    robot_named(_name)
shipped_meshes(first_state().robot)
