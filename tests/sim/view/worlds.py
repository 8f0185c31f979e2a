"""A world in which more than the robot moves."""

import dataclasses

from sim import World
from sim.world import MovableBox, OtherRobot

CROWDED = dataclasses.replace(
    World.load("yard"),
    movable=(MovableBox(x=1.0, y=1.0, yaw=0.0, width=0.4, height=0.2),),
    robots=(OtherRobot(name="leader", start=(1.0, -1.0, 0.0)),),
)
