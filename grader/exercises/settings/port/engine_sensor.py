"""A sensor on an engine that publishes volts, and a node that sets the gain of the student's node."""

import functools
import random
from collections.abc import Callable

from rcl_interfaces.srv import SetParameters
from rclpy.node import Node
from std_msgs.msg import Float64

from grader.companions.schedule import Row, Schedule
from grader.companions.service_clients import ServiceCaller, call_at, set_parameter

VOLTS = "/engine/volts"
FIRST, SET_AT = 1.4, 4.1  # s: the first message, and when the gain is set
COOL, HOT = (0.6, 2.9), (3.4, 4.6)  # V
GAPS = 0.28, 0.9, 0.44, 1.7, 0.35, 0.61  # s from one message to the next, in an order of the seed's


class GainSetter(ServiceCaller):
    """Sets the parameter `gain` of /thermometer once."""

    def __init__(self, gain: float) -> None:
        super().__init__("gain_setter")
        self.client = self.create_client(SetParameters, "/thermometer/set_parameters")
        call_at(self, SET_AT, lambda: set_parameter(self, self.client, "gain", gain))


def engine(seed: int) -> list[Callable[[], Node]]:
    """Return a program that publishes volts (Float64) on /engine/volts, at uneven times."""
    draw = random.Random(f"engine {seed}")
    stamp, rows = FIRST, list[Row]()
    for number, gap in enumerate(draw.sample(GAPS, len(GAPS)) + draw.sample(GAPS, len(GAPS))):
        volts = draw.uniform(*(COOL, HOT)[number % 2])
        rows.append((round(stamp, 3), VOLTS, Float64(data=round(volts, 3))))
        stamp += gap * draw.uniform(0.9, 1.1)
    return [functools.partial(Schedule, "engine", rows)]


def engine_and_gain_setter(seed: int) -> list[Callable[[], Node]]:
    """Return the same, and a node that sets the gain."""
    return [*engine(seed), functools.partial(GainSetter, gain_of(seed))]


def gain_of(seed: int) -> float:
    """Return the gain that is set."""
    return round(random.Random(f"gain {seed}").uniform(28.0, 35.0), 2)
