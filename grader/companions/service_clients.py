"""Programs that call students' services. Everything they do varies with the run's seed."""

import random
from collections.abc import Callable
from functools import partial
from typing import Any

from example_interfaces.srv import AddTwoInts
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.client import Client
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

from grader.checks.fields import plain, words

READINGS = 50  # that a calibration takes the mean of


class ServiceCaller(Node):
    """Calls the student's services, logs the responses, and never waits for one."""

    def call(self, client: Client, request: Any) -> None:
        """Call a service, and log the response."""
        fields = words(plain(request))
        request_text = f"{client.service_name} ({fields})" if fields else client.service_name
        if not client.service_is_ready():
            self.get_logger().info(f"{request_text}: no node offers this service")
        future = client.call_async(request)
        future.add_done_callback(
            lambda future: self.get_logger().info(f"{request_text} -> {words(plain(future.result()))}")
        )


class Questioner(ServiceCaller):
    """Calls /add_two_ints (AddTwoInts) once a second, with numbers of every kind."""

    def __init__(self) -> None:
        super().__init__("questioner")
        self.client = self.create_client(AddTwoInts, "/add_two_ints")
        self.pairs = [(random.randint(-99, 99), random.randint(1, 99)) for _ in range(4)]
        self.pairs.append((random.randint(10**9, 10**12), random.randint(-99, -1)))
        self.create_timer(1.0, self.next)

    def next(self) -> None:
        """Send the next request, as long as there is one."""
        if self.pairs:
            a, b = self.pairs.pop()
            self.call(self.client, AddTwoInts.Request(a=a, b=b))


class Technician(ServiceCaller):
    """Calls /gyro/calibrate (Trigger): twice too early, then in time, then when the gyro is warm."""

    def __init__(self) -> None:
        super().__init__("technician")
        self.client = self.create_client(Trigger, "/gyro/calibrate")
        for moment in (0.6, 1.5, random.uniform(3.0, 4.0), random.uniform(8.0, 8.5)):
            call_at(self, moment, lambda: self.call(self.client, Trigger.Request()))


class Pilot(ServiceCaller):
    """Calls /arm (SetBool): disarms what is not armed, arms, disarms, arms twice, disarms."""

    def __init__(self) -> None:
        super().__init__("pilot")
        self.client = self.create_client(SetBool, "/arm")
        moment = random.uniform(0.5, 2.5)
        for armed in (False, True, False, True, True, False):
            call_at(self, moment, partial(self.call, self.client, SetBool.Request(data=armed)))
            moment += random.uniform(1.2, 2.6)


class Reader(ServiceCaller):
    """Reads the parameter `speed` of /cruiser."""

    def __init__(self, name: str = "reader") -> None:
        super().__init__(name)
        self.get = self.create_client(GetParameters, "/cruiser/get_parameters")
        call_at(self, 0.7, lambda: self.call(self.get, GetParameters.Request(names=["speed"])))


class ModeReader(ServiceCaller):
    """Reads the parameter `mode` of /manager."""

    def __init__(self) -> None:
        super().__init__("reader")
        self.get = self.create_client(GetParameters, "/manager/get_parameters")
        call_at(self, 0.7, lambda: self.call(self.get, GetParameters.Request(names=["mode"])))


class Tuner(Reader):
    """Reads the parameter `speed` of /cruiser, then sets it: to allowed values, and to others."""

    def __init__(self) -> None:
        super().__init__("tuner")
        self.set = self.create_client(SetParameters, "/cruiser/set_parameters")
        speeds = [random.randint(40, 45) / 100, random.randint(55, 90) / 100, -0.1, 0.1, 0.5, 0.51, 0.0]
        for number, speed in enumerate(speeds):
            moment = 2.0 + 1.5 * number
            call_at(self, moment, partial(set_parameter, self, self.set, "speed", speed))


class Operator(ServiceCaller):
    """Operates the mode manager: /arm (SetBool), /reset (Trigger) and the parameter `mode` of /manager.

    First everything that is allowed, and a mode that does not exist; then ahead until the robot bumps into
    something. Then it arms once more, resets, and drives away.
    """

    def __init__(self) -> None:
        super().__init__("operator")
        arming, resetting = self.create_client(SetBool, "/arm"), self.create_client(Trigger, "/reset")
        arm, disarm = (partial(self.call, arming, SetBool.Request(data=armed)) for armed in (True, False))
        self.setting = self.create_client(SetParameters, "/manager/set_parameters")
        self.bumped = False
        self.create_subscription(Bool, "/bumper", self.on_bumper, 10)
        turning = random.uniform(2.0, 4.0)
        wrong = random.choice(("dance", "Circle", "", "aheads"))
        self.plan(1.0, arm, self.mode("circle"), None, lambda: None)
        self.plan(2.0 + turning, self.mode(wrong), disarm, self.mode("ahead"), arm)
        reset = partial(self.call, resetting, Trigger.Request())
        self.after_a_bump = arm, reset, self.mode("back"), arm, None, disarm

    def plan(self, begin: float, *steps: Callable[[], None] | None) -> None:
        """Take the steps one after the other, one a second."""
        for number, step in enumerate(steps):
            if step:
                call_at(self, begin + number, step)

    def mode(self, name: str) -> Callable[[], None]:
        """Return an action that sets the mode."""
        return lambda: set_parameter(self, self.setting, "mode", name)

    def on_bumper(self, msg: Bool) -> None:
        """After the first bump: try to arm, reset, drive away."""
        if msg.data and not self.bumped:
            self.bumped = True
            self.plan(1.0, *self.after_a_bump)


def call_at(node: Node, moment: float, action: Callable[[], None]) -> None:
    """Do something once, so many seconds from now."""

    def once() -> None:
        timer.cancel()
        action()

    timer = node.create_timer(moment, once)


def set_parameter(caller: ServiceCaller, client: Client, name: str, value: float | str) -> None:
    """Set one parameter of the student's node, over its service."""
    parameter = Parameter(name, value=value).to_parameter_msg()
    caller.call(client, SetParameters.Request(parameters=[parameter]))
