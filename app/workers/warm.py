"""What every session needs and can be had before there is one: modules, the usual arms, their shapes.

Imported for what it does, by the process that the workers of a server are forked from: a worker that takes the place of
one that died then costs its neighbours a tenth of a second of the processor and not two.
"""

from __future__ import annotations

from app.kinematics import robot_names
from app.scene.arm import arm_meshes
from app.scene.client_page import client_page
from app.screens import screens
from app.session.motion.guarding import guard_of
from app.session.state import first_state, robot_named
from app.simulation.world import default_world

screens()
client_page()
for _name in robot_names():
    robot_named(_name)
_usual = default_world(robot_named(first_state().robot))
arm_meshes(_usual.robot)
guard_of(_usual)
