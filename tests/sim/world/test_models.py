"""Figures that cannot be are refused by the models, from Python as from a world file."""

import dataclasses
import math

import numpy as np
import pytest

from sim.world import (
    Box,
    ImuModel,
    LidarModel,
    ModelError,
    MovableBox,
    OtherRobot,
    RobotModel,
    Simulation,
    WarehouseModel,
    WheelModel,
    World,
)

NAME = "a name of small letters, digits and single underscores that begins with a letter"
ROUTE = "[[x, y], ...], two or more corners (meters), each different from the one before"


@pytest.mark.parametrize(("model", "parameters", "sentence"), [
    (RobotModel, {"radius": -1}, "radius is -1; write a number from 0.0001 to 1000 (meters)."),
    (RobotModel, {"mass": 0}, "mass is 0; write a number from 0.0001 to 1000000 (kg)."),
    (RobotModel, {"mass": 5e-324}, "mass is 5e-324; write a number from 0.0001 to 1000000 (kg)."),
    (RobotModel, {"max_v": math.nan}, "max_v is nan; write a number from 0.0001 to 1000000 (m/s)."),
    (RobotModel, {"max_w": math.inf}, "max_w is inf; write a number from 0.0001 to 1000000 (rad/s)."),
    (RobotModel, {"mass": "1"}, "mass is '1'; write a number from 0.0001 to 1000000 (kg)."),
    (RobotModel, {"mass": True}, "mass is True; write a number from 0.0001 to 1000000 (kg)."),
    (RobotModel, {"command_timeout": 0},
     "command_timeout is 0; write a number from 0.01 to 1000 (seconds)."),
    (RobotModel, {"stamped": 1}, "stamped is 1; write true or false."),
    (RobotModel, {"carried": [[1, 0, 0]]},
     "carried is [[1, 0, 0]]; write a list of [time, x, y, yaw] (s, meters, radians)."),
    (RobotModel, {"carried": [[-1, 0, 0, 0]]},
     "carried is [[-1, 0, 0, 0]]; write a list of [time, x, y, yaw] (s, meters, radians)."),
    (RobotModel, {"friction": -0.1}, "friction is -0.1; write a number from 0 to 10."),
    (RobotModel, {"odometry": (0, 1)}, "odometry is [0, 1]; write [x, y, yaw] (meters and radians)."),
    (RobotModel, {"max_v": 11},
     "max_v is 11.0; write 10 m/s or less, one radius in a physics step of 0.01 s."),
    (RobotModel, {"max_force": 2},
     "max_force is 2.0; write more than 2.5 N, which the robot's ramps and curves need."),
    (RobotModel, {"max_torque": 0.04},
     "max_torque is 0.04; write more than 0.04 N m, which the robot's ramps need."),
    (LidarModel, {"rays": 0}, "rays is 0; write a whole number from 1 to 10000."),
    (LidarModel, {"rays": 10**9}, "rays is 1000000000; write a whole number from 1 to 10000."),
    (LidarModel, {"rays": 36.0}, "rays is 36.0; write a whole number from 1 to 10000."),
    (LidarModel, {"rays": 10**5000},
     "rays is a number of thousands of digits; write a whole number from 1 to 10000."),
    (LidarModel, {"range_min": 3.5}, "range_min is 3.5; write a number below range_max, 3.5 (meters)."),
    (LidarModel, {"noise": -1}, "noise is -1; write a number from 0 to 1000000 (meters)."),
    (RobotModel, {"mass": 1e300}, "mass is 1e+300; write a number from 0.0001 to 1000000 (kg)."),
    (ImuModel, {"gyro_noise": 1e300}, "gyro_noise is 1e+300; write a number from 0 to 1000000 (rad/s)."),
    (LidarModel, {"x": 2}, "x is 2; write a number from -1 to 1 (meters)."),
    (LidarModel, {"yaw": math.inf}, "yaw is inf; write a finite number (radians)."),
    (LidarModel, {"dropouts": 1.5}, "dropouts is 1.5; write a number from 0 to 1."),
    (LidarModel, {"latency": -1}, "latency is -1; write a number from 0 to 1000000 (s)."),
    (LidarModel, {"x_error": 2}, "x_error is 2; write a number from -1 to 1 (meters)."),
    (LidarModel, {"y_error": -2}, "y_error is -2; write a number from -1 to 1 (meters)."),
    (LidarModel, {"yaw_error": math.nan}, "yaw_error is nan; write a finite number (radians)."),
    (LidarModel, {"clock_offset": 200}, "clock_offset is 200; write a number from -100 to 100 (s)."),
    (LidarModel, {"transform_delay": -1}, "transform_delay is -1; write a number from 0 to 1000000 (s)."),
    (LidarModel, {"silent": [[4, 2]]}, "silent is [[4, 2]]; write a list of spans [begin, end] (s)."),
    (WarehouseModel, {"pickups": [[1, 0, 0]], "desk": [0, 0, 0], "withdrawn": [-1]},
     "withdrawn is [-1]; write a list of moments (s), 0 or later."),
    (ImuModel, {"rate": 200}, "rate is 200; write a number from 1 to 100 (Hz)."),
    (ImuModel, {"gyro_bias": -1}, "gyro_bias is -1; write a number from 0 to 1000000 (rad/s)."),
    (ImuModel, {"accel_noise": None}, "accel_noise is None; write a number from 0 to 1000000 (m/s^2)."),
    (WheelModel, {"slip": 0.1}, "slip is 0.1; write a number from 0 to 0.03 (meters)."),
    (WheelModel, {"radius_error": math.nan}, "radius_error is nan; write a number from 0 to 0.1."),
    (WheelModel, {"ticks": 12.5}, "ticks is 12.5; write a whole number from 0 to 100000."),
    (WheelModel, {"left_scale": 2}, "left_scale is 2; write a number from 0.8 to 1.25."),
    (Box, {"x": 1e9, "y": 0, "yaw": 0, "width": 1, "height": 1},
     "x is 1000000000.0; write a number from -1000 to 1000 (meters)."),
    (MovableBox, {"x": 0, "y": 0, "yaw": 0, "width": 1e-300, "height": 1},
     "width is 1e-300; write a number from 0.0001 to 1000 (meters)."),
    (MovableBox, {"x": 0, "y": 0, "yaw": 0, "width": 1, "height": 1, "mass": -1},
     "mass is -1; write a number from 0.0001 to 1000000 (kg)."),
    (MovableBox, {"x": 0, "y": 0, "yaw": 0, "width": 1, "height": 1, "friction": 0},
     "friction is 0; write a number from 0.01 to 10."),
    (OtherRobot, {"name": "Bob 1", "start": (0, 0, 0)}, f"name is 'Bob 1'; write {NAME}."),
    (OtherRobot, {"name": "a__b", "start": (0, 0, 0)}, f"name is 'a__b'; write {NAME}."),
    (OtherRobot, {"name": "a", "start": (0, 0)},
     "start is [0, 0]; write [x, y, yaw] (meters and radians)."),
    (OtherRobot, {"name": "a", "start": (0, 0, 0), "route": ((1, 1),)},
     f"route is [[1, 1]]; write {ROUTE}."),
    (OtherRobot, {"name": "a", "start": (0, 0, 0), "route": ((1, 1), (2, 2), (1, 1))},
     f"route is [[1, 1], [2, 2], [1, 1]]; write {ROUTE}."),
])  # fmt: skip
def test_invalid_values(model, parameters, sentence):
    with pytest.raises(ModelError) as caught:
        model(**parameters)
    assert str(caught.value) == f"{model.__name__}: {sentence}"


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            {"start": (math.nan, 0, 0)},
            "start is [nan, 0, 0]; write [x, y, yaw] (meters and radians) inside the bounds.",
        ),
        ({"goal": (9, 9)}, "goal is [9.0, 9.0]; write [x, y] (meters) inside the bounds."),
        ({"lidar": 3}, "lidar is 3; write a LidarModel."),
        (
            {"lidar": LidarModel(x=0.08, y=-0.08)},
            "lidar is LidarModel(rays=360, range_min=0.12, range_max=3.5, noise=0.01, dropouts=0.0,...; "
            "write a lidar on the robot, whose radius is 0.1 m.",
        ),
        (
            {"lidar": LidarModel(x=0.08, y_error=0.08)},
            "lidar is LidarModel(rays=360, range_min=0.12, range_max=3.5, noise=0.01, dropouts=0.0,...; "
            "write a lidar on the robot, whose radius is 0.1 m.",
        ),
        ({"robots": (3,)}, "robots is [3]; write a list of OtherRobot."),
        ({"name": 3}, "name is 3; write a text."),
        (
            {"walls": (((1, 1), (1, 1)),)},
            "walls is [[[1, 1], [1, 1]]]; write a list of walls, each a list of two or more corners [x, y] "
            "(meters), each different from the one before.",
        ),
    ],
)
def test_a_changed_world_that_cannot_be(changes, sentence):
    with pytest.raises(ModelError) as caught:
        dataclasses.replace(World.load("yard"), **changes)
    assert str(caught.value) == f"World: {sentence}"


def test_long_values_are_cut():
    with pytest.raises(ModelError) as caught:
        dataclasses.replace(World.load("yard"), walls=[[[i, i], [i, i]] for i in range(100)])
    assert "[[3, 3], [3, 3]], [[4,...; write a list of walls" in str(caught.value)
    assert len(str(caught.value)) < 250


def test_numbers_of_other_kinds_become_floats_and_lists_tuples():
    robot = OtherRobot("a", [np.float64(1), np.int64(2), 3])
    assert robot.start == (1.0, 2.0, 3.0)
    assert {type(value) for value in robot.start} == {float}
    assert hash(robot) == hash(OtherRobot("a", (1.0, 2.0, 3.0)))


def test_a_zero_with_a_sign_is_a_zero():
    model = ImuModel(gyro_bias=-0.0, accel_bias=-0.0)
    assert math.copysign(1, model.gyro_bias) == 1
    world = dataclasses.replace(World.load("room"), imu=model)
    assert math.isfinite(Simulation(world).robots["robot"].imu().w)
