"""A small robot in a flat world, with its sensors: plain Python, pymunk and numpy; knows nothing of ROS."""

from sim.world.battery import Battery, BatteryModel
from sim.world.bodies import Body
from sim.world.contacts import Contact
from sim.world.description import World
from sim.world.drawing import Drawing, Stroke
from sim.world.imu import ImuModel, ImuReading
from sim.world.lidar import LidarModel, Scan
from sim.world.mobile_robot import MobileRobot
from sim.world.model import ModelError, WorldError
from sim.world.obstacles import Box, Circle, MovableBox
from sim.world.people import Person
from sim.world.robot import DT, CommandError, Odometry, OtherRobot, RobotModel, Wheels
from sim.world.route import Route
from sim.world.scene import Scene, simulate
from sim.world.simulation import Simulation
from sim.world.warehouse import WarehouseModel

__all__ = [
    "DT",
    "Battery",
    "BatteryModel",
    "Body",
    "Box",
    "Circle",
    "CommandError",
    "Contact",
    "Drawing",
    "ImuModel",
    "ImuReading",
    "LidarModel",
    "MobileRobot",
    "ModelError",
    "MovableBox",
    "Odometry",
    "OtherRobot",
    "Person",
    "RobotModel",
    "Route",
    "Scan",
    "Scene",
    "Simulation",
    "Stroke",
    "WarehouseModel",
    "Wheels",
    "World",
    "WorldError",
    "simulate",
]
