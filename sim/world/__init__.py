"""A simulated robot with its sensors in a flat world: plain Python, pymunk and numpy, independent of ROS."""

from sim.world.battery import Battery, BatteryModel
from sim.world.bodies import Body
from sim.world.contacts import Contact
from sim.world.imu import ImuModel, ImuReading
from sim.world.lidar import LidarModel, Scan
from sim.world.mobile_robot import MobileRobot
from sim.world.obstacles import Box, Circle, MovableBox
from sim.world.pen_drawing import PenDrawing, Stroke
from sim.world.people import Person
from sim.world.robot import DT, CommandError, Odometry, OtherRobot, RobotModel, WheelJoints
from sim.world.route import Route
from sim.world.scene import Scene, simulate
from sim.world.simulation import Simulation
from sim.world.validated_model import ModelError, WorldError
from sim.world.warehouse import WarehouseModel
from sim.world.wheels import WheelModel
from sim.world.world import World

__all__ = [
    "DT",
    "Battery",
    "BatteryModel",
    "Body",
    "Box",
    "Circle",
    "CommandError",
    "Contact",
    "ImuModel",
    "ImuReading",
    "LidarModel",
    "MobileRobot",
    "ModelError",
    "MovableBox",
    "Odometry",
    "OtherRobot",
    "PenDrawing",
    "Person",
    "RobotModel",
    "Route",
    "Scan",
    "Scene",
    "Simulation",
    "Stroke",
    "WarehouseModel",
    "WheelJoints",
    "WheelModel",
    "World",
    "WorldError",
    "simulate",
]
