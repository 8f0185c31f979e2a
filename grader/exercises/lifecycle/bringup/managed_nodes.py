"""A robot of three lifecycle nodes, whose transitions take a moment and sometimes fail, and its operator."""

import functools
import math
import random
from collections.abc import Callable, Sequence
from typing import Any

from geometry_msgs.msg import Twist
from lifecycle_msgs.srv import ChangeState
from rclpy.duration import Duration
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from grader.companions.service_clients import call_at

NODES = ("sensor", "filter", "controller")  # in the order in which they are brought up
SHUTDOWN = "/bringup/shutdown"
ALWAYS = 1000  # failures; more than anyone tries
DURING = 0.7, 1.0  # s: the configurations take longer, as there are six requests of 0.1 s or more
AHEAD, NEAR = 0.6, 0.5  # rad to either side, m
SPEED, TURN = 0.2, 0.8  # m/s, rad/s


class ManagedNode(LifecycleNode):
    """A lifecycle node that fails the first times that some of its transitions are requested.

    failures: how often each of them fails, such as {"configure": 2}.
    """

    def __init__(self, name: str, failures: dict[str, int]) -> None:
        super().__init__(name)
        self.failures = dict(failures)
        self.active = False
        service = next(each for each in self.services if each.service_name.endswith("/change_state"))
        self.change, service.callback = service.callback, self.change_or_refuse

    def change_or_refuse(
        self, request: ChangeState.Request, response: ChangeState.Response
    ) -> ChangeState.Response:
        """Refuse a transition that the state doesn't have, as nodes in C++ do; rclpy's nodes die of it."""
        try:
            return self.change(request, response)
        except RuntimeError:  # RCLError is one, and has no public name
            response.success = False
            return response

    def attempt(self, transition: str) -> TransitionCallbackReturn:
        """Take a moment, and fail if a failure is left."""
        self.get_clock().sleep_for(Duration(seconds=random.uniform(0.1, 0.3)))
        if self.failures.get(transition, 0) > 0:
            self.failures[transition] -= 1
            self.get_logger().info(f"{transition} has failed: the device isn't ready")
            return TransitionCallbackReturn.FAILURE
        return TransitionCallbackReturn.SUCCESS

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Connect to the device."""
        return self.attempt("configure")

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Begin to work."""
        result = self.attempt("activate")
        self.active = result == TransitionCallbackReturn.SUCCESS
        return result

    def end_work(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop working; the same for each transition that ends it."""
        self.active = False
        self.rest()
        self.get_clock().sleep_for(Duration(seconds=0.05))
        return TransitionCallbackReturn.SUCCESS

    on_deactivate = on_cleanup = on_shutdown = on_error = end_work

    def rest(self) -> None:
        """Do what is due when the work ends."""


class DistanceSensor(ManagedNode):
    """Publishes on /distance (Float64, m) how far it is to whatever is ahead, from /scan."""

    def __init__(self, failures: dict[str, int]) -> None:
        super().__init__("sensor", failures)
        self.distances = self.create_publisher(Float64, "/distance", 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)

    def on_scan(self, scan: LaserScan) -> None:
        """Publish the least distance ahead."""
        angles = (scan.angle_min + i * scan.angle_increment for i in range(len(scan.ranges)))
        ahead = [r for a, r in zip(angles, scan.ranges, strict=True) if math.cos(a) > math.cos(AHEAD)]
        if self.active:
            self.distances.publish(Float64(data=min(filter(math.isfinite, ahead), default=math.inf)))


class DistanceFilter(ManagedNode):
    """Publishes on /distance/filtered the least of the last three distances."""

    def __init__(self, failures: dict[str, int]) -> None:
        super().__init__("filter", failures)
        self.latest: list[float] = []
        self.filtered = self.create_publisher(Float64, "/distance/filtered", 10)
        self.create_subscription(Float64, "/distance", self.on_distance, 10)

    def on_distance(self, msg: Float64) -> None:
        """Publish the least of three."""
        self.latest = [*self.latest, msg.data][-3:]
        if self.active:
            self.filtered.publish(Float64(data=min(self.latest)))


class RoomDriver(ManagedNode):
    """Drives, and turns where something is near. Until a distance arrives, it takes the way to be clear."""

    def __init__(self, failures: dict[str, int]) -> None:
        super().__init__("controller", failures)
        self.distance = math.inf
        self.commands = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Float64, "/distance/filtered", self.on_distance, 10)
        self.create_timer(0.1, self.drive)

    def on_distance(self, msg: Float64) -> None:
        """Store it."""
        self.distance = msg.data

    def drive(self) -> None:
        """Send a command, while active."""
        if self.active:
            command = Twist()
            command.linear.x, command.angular.z = (SPEED, 0.0) if self.distance > NEAR else (0.0, TURN)
            self.commands.publish(command)

    def rest(self) -> None:
        """Stop the robot."""
        self.commands.publish(Twist())


class ShutdownOperator(Node):
    """Calls /bringup/shutdown (Trigger) once, when the robot has been driving for a while.

    between: the earliest and the latest time for it, s.
    """

    def __init__(self, between: tuple[float, float] = (8.0, 9.0)) -> None:
        super().__init__("operator")
        self.client = self.create_client(Trigger, SHUTDOWN)
        call_at(self, random.uniform(*between), self.end)

    def end(self) -> None:
        """Request the shutdown."""
        self.client.call_async(Trigger.Request())


def robot(seed: int) -> Sequence[Callable[[], Any]]:
    """Return the three nodes, two of which can't be configured at first, and the operator."""
    return [*_slow_to_configure(seed), ShutdownOperator]


def interrupted(seed: int) -> Sequence[Callable[[], Any]]:
    """Return the same nodes, and an operator who calls while they are being configured."""
    return [*_slow_to_configure(seed), functools.partial(ShutdownOperator, DURING)]


def never_configured(seed: int) -> Sequence[Callable[[], Any]]:
    """Return the three nodes, one of which can't be configured: not the first."""
    return _nodes({random.Random(seed).choice(NODES[1:]): ALWAYS}, "configure")


def never_active(seed: int) -> Sequence[Callable[[], Any]]:
    """Return the three nodes, one of which can't be activated: not the last."""
    return _nodes({random.Random(seed).choice(NODES[:-1]): ALWAYS}, "activate")


def _slow_to_configure(seed: int) -> list[Callable[[], Any]]:
    once, twice = random.Random(seed).sample(NODES, 2)
    return _nodes({once: 1, twice: 2}, "configure")


def _nodes(failures: dict[str, int], transition: str) -> list[Callable[[], Any]]:
    classes = zip(NODES, (DistanceSensor, DistanceFilter, RoomDriver), strict=True)
    return [functools.partial(made, {transition: failures.get(name, 0)}) for name, made in classes]
