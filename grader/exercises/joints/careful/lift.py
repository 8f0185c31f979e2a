"""A lift that gets stuck, and requests for positions, some of them beyond its limits."""

import functools
import math
import random
from collections.abc import Callable
from typing import NamedTuple

from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, String

from grader.companions.qos import LATCHED
from grader.companions.schedule import Schedule
from grader.geometry.near import is_near
from sim.world.machines import JointModel, urdf
from sim.world.machines.urdf import EFFORT

JOINT, OTHER = "lift_joint", "fan_joint"
PERIOD, SPEED = 0.05, 0.6  # s, rad/s
START = 4  # periods in which a lift at rest pulls with full effort before it moves
MOVING, HOLDING = 0.3 * EFFORT, 0.05 * EFFORT  # N m
FREED = 0.05  # rad; a command this close to where it is stuck frees it
NOISE, BACKLASH = 0.001, 0.005  # rad and rad/s, of the encoder; rad, a gap that is too small to move
BEGIN, PAUSE = 1.0, 2.8  # s: until the first request, and between two


class Plan(NamedTuple):
    """The lift of a seed, and the positions that are requested."""

    lower: float  # rad
    upper: float
    fan_first: bool  # in /joint_states
    requests: list[float]  # rad; two at the limits, some beyond them, one NaN
    jams: list[float]  # where the lift gets stuck, once each


def plan(seed: int) -> Plan:
    """Return the plan of a seed: five positions within the limits; on its way to two it gets stuck."""
    draw = random.Random(f"lift {seed}")
    middle, half = draw.uniform(-0.45, 0.45), draw.uniform(0.66, 0.76)  # no limits hold for two lifts
    lower, upper, places = round(middle - half, 2), round(middle + half, 2), []
    for index in range(5):  # up and down in turns
        ahead = 1 if index % 2 else -1
        places.append(round(middle + ahead * draw.uniform(0.3, 0.6), 2))
    if draw.random() < 0.5:
        places = [round(2 * middle - place, 2) for place in places]
    places[0], places[3] = (upper, lower) if places[0] > middle else (lower, upper)
    first = draw.choice((1, 2))  # not two in a row, because the second would then start from elsewhere
    jams = [(places[index - 1] + places[index]) / 2 for index in (first, first + draw.choice((1, 2)))]
    requests = list(places)
    bad = [upper + draw.uniform(0.05, 0.3), lower - draw.uniform(0.05, 0.3), math.nan]
    for wrong in draw.sample(bad, 3):
        requests.insert(draw.randrange(1, len(requests)), round(wrong, 2))
    return Plan(lower, upper, draw.random() < 0.7 or seed == 1, requests, jams)


class Lift(Node):
    """A lift: takes /joint_commands (Float64), gives /joint_states with effort, and /robot_description.

    Where it is stuck it pulls with full effort until it is commanded to stay there.
    """

    def __init__(self, plan: Plan) -> None:
        super().__init__("lift")
        self.plan, self.jams = plan, list(plan.jams)
        self.position = self.target = self.velocity = self.effort = 0.0
        self.stuck, self.starting, self.turns = False, 0, 0.0
        self.errors = random.Random("encoder")
        model = JointModel(plan.lower, plan.upper, 0.0, SPEED)
        self.description = self.create_publisher(String, "/robot_description", LATCHED)
        text = urdf("lift", [JOINT], [model], ["base_link", "platform", "top"])
        self.description.publish(String(data=text))
        self.states = self.create_publisher(JointState, "/joint_states", 10)
        self.create_subscription(Float64, "/joint_commands", self.obey, 10)
        self.create_timer(PERIOD, self.step)

    def obey(self, msg: Float64) -> None:
        """Take a new target, cut to the limits; NaN is ignored."""
        if math.isnan(msg.data):
            return
        self.target = min(max(msg.data, self.plan.lower), self.plan.upper)
        if self.stuck and abs(self.target - self.position) < FREED:
            self.stuck, self.target = False, self.position
        self.starting = 0 if self.velocity else START

    def step(self) -> None:
        """Move for one period, and publish the joint states."""
        gap = self.target - self.position
        ahead = math.copysign(1.0, gap)
        self.velocity, self.effort = 0.0, HOLDING
        if not is_near(gap, 0.0, BACKLASH):
            self.effort = ahead * EFFORT
            if self.starting:
                self.starting -= 1
            elif not self.stuck:
                self._move(ahead * min(abs(gap), SPEED * PERIOD))
        self._report()

    def _move(self, way: float) -> None:
        low, high = sorted((self.position, self.position + way))
        if self.jams and low <= self.jams[0] <= high:
            self.stuck, self.position = True, self.jams.pop(0)
        else:
            self.velocity, self.effort = way / PERIOD, math.copysign(MOVING, way)
            self.position += way

    def _report(self) -> None:
        self.turns += 0.3
        position, velocity = (self.errors.gauss(value, NOISE) for value in (self.position, self.velocity))
        rows = [(JOINT, position, velocity, self.effort), (OTHER, self.turns, 6.0, EFFORT)]
        if self.plan.fan_first:
            rows.reverse()
        names, *values = zip(*rows, strict=True)
        message = JointState(name=names, position=values[0], velocity=values[1], effort=values[2])
        message.header.stamp = self.get_clock().now().to_msg()
        self.states.publish(message)


def lift(seed: int) -> list[Callable[[], Node]]:
    """Return the lift of a seed, and a program that requests positions on /wanted (Float64)."""
    made = plan(seed)
    requests = (Float64(data=position) for position in made.requests)
    rows = [(BEGIN + number * PAUSE, "/wanted", request) for number, request in enumerate(requests)]
    return [functools.partial(Lift, made), functools.partial(Schedule, "caller", rows)]
