"""Publishes a robot's IMU as sensor_msgs/Imu, as REP-145 specifies."""

from __future__ import annotations

import math

from geometry_msgs.msg import Vector3
from rclpy.node import Node
from sensor_msgs.msg import Imu
from std_msgs.msg import Header

from sim.nanoseconds import SECOND
from sim.ros.messages.template import Template
from sim.world import ImuModel, MobileRobot

FIELDS = (
    *(
        "header.stamp.sec",
        "header.stamp.nanosec",
        "orientation.z",
        "orientation.w",
        "orientation_covariance.8",
    ),
    *("angular_velocity.z", *(f"linear_acceleration.{axis}" for axis in "xyz")),
)


class ImuTopic:
    """Publishes imu/data in base_link: yaw since the start, yaw rate, acceleration, and their variances.

    The acceleration includes gravity: at rest z is 9.8 m/s^2. The yaw is integrated from the measured rates,
    so it drifts, and its variance grows with time. Roll and pitch are exactly 0 in a flat world.
    """

    def __init__(self, node: Node, robot: MobileRobot, model: ImuModel, frame: str) -> None:
        self._robot, self._model = robot, model
        gyro, accel = (
            noise**2 + variance_of(bias)
            for noise, bias in ((model.gyro_noise, model.gyro_bias), (model.accel_noise, model.accel_bias))
        )
        message = Imu(
            header=Header(frame_id=frame),
            angular_velocity_covariance=[0.0] * 8 + [gyro],
            linear_acceleration=Vector3(),
            linear_acceleration_covariance=[accel, 0.0, 0.0, 0.0, accel, 0.0, 0.0, 0.0, accel],
        )
        self._template = Template(message, FIELDS)
        self._publisher = node.create_publisher(Imu, "imu/data", 10)

    def publish(self, now: int) -> None:
        """Measure and publish; `now` is the node's time in nanoseconds, to which the world has advanced."""
        reading, model = self._robot.imu(), self._model
        half = reading.yaw / 2
        # The variance from a constant bias of the rate plus independent noise in each reading.
        drift = (
            variance_of(model.gyro_bias) * reading.stamp**2 + model.gyro_noise**2 * reading.stamp / model.rate
        )
        turn = math.sin(half), math.cos(half), drift
        self._publisher.publish(
            self._template.fill(*divmod(now, SECOND), *turn, reading.w, reading.ax, reading.ay, reading.az)
        )


def variance_of(bias: float) -> float:
    """The variance of a bias drawn uniformly from half to all of this magnitude, of either sign."""
    return 7 / 12 * bias**2
