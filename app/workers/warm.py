"""What every session needs and can be had before there is one: modules, the usual arms, their shapes.

Imported for what it does, by the process that the workers of a server are forked from: a worker that takes the place of
one that died then costs its neighbours a tenth of a second of the processor and not two, and its first people wait for
nothing that is read when it is first needed.
"""

from __future__ import annotations

import rich.panel
import rich.table  # noqa: F401 -- viser reads both when its server begins

from app import catalog
from app.calibration.exchange import formats
from app.calibration.vocabularies import vocabularies
from app.kinematics import robot_names
from app.scene.arm import arm_meshes
from app.scene.client_page import client_page
from app.screens import screens
from app.session.motion.guarding import guard_of
from app.session.reducer import STEPS
from app.session.state import first_state, robot_named
from app.simulation.world import default_world
from app.texts import languages

screens()
languages()
formats()
vocabularies()
catalog.modules(STEPS)
client_page()
for _name in robot_names():
    robot_named(_name)
_usual = default_world(robot_named(first_state().robot))
arm_meshes(_usual.robot)
guard_of(_usual)
