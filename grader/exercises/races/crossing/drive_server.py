"""An action server that drives, takes its time to answer, and dies at times; and a user of its client."""

from __future__ import annotations

import functools
import random
from collections.abc import Callable
from typing import Any, NamedTuple

from geometry_msgs.msg import Twist
from nav2_msgs.action import DriveOnHeading
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import Empty, Float64

from grader.companions.action_servers import PausableNode
from grader.worlds.trusting import trusting
from sim.evidence import Seconds
from sim.world import World

ACTION, COMMANDS, SPEED = "/drive_on_heading", "/commander/cmd_vel", 0.25  # m/s
TICK, ACCEPTS_AFTER, RESULT_AFTER, DEAD = 0.1, 0.2, 0.3, 1e5  # s
DIED = "died"  # what is logged then, so that checks know
PLAIN, CROSSING, NEWER, RESTART = SCENARIOS = "plain", "crossing", "newer", "restart"


class DriveStep(NamedTuple):
    """One message of the user: a distance (m), or None for a stop."""

    stamp: Seconds
    meters: float | None


class DrivePlan(NamedTuple):
    """All that happens in a run. dies: when the server dies, and for how long it is away."""

    steps: tuple[DriveStep, ...]
    dies: tuple[tuple[Seconds, Seconds], ...]


def plan_of(name: str, seed: int) -> DrivePlan:
    """Return what happens in a scenario; all times are drawn, those of one thing far from those of others."""
    draw = random.Random(f"{name} {seed}")
    steps: list[DriveStep] = []
    dies: list[tuple[Seconds, Seconds]] = []
    now = 2.0
    for kind in draw.sample(KINDS[name], len(KINDS[name])):
        now = _add(kind, now + draw.uniform(0.0, 0.5), draw, steps, dies)
    return DrivePlan(tuple(steps), tuple(dies))


LONGEST = {PLAIN: 16.0, CROSSING: 22.0, NEWER: 23.0, RESTART: 29.0}  # s
KINDS = {
    PLAIN: ("arrives", "canceled"),
    CROSSING: ("too late", "last moment", "too early"),
    NEWER: ("replaced", "replaced and stopped", "replaced at once"),
    RESTART: ("away", "back at once"),
}


def _add(
    kind: str, now: Seconds, draw: random.Random, steps: list[DriveStep], dies: list[tuple[Seconds, Seconds]]
) -> Seconds:
    """Add one episode that begins now; returns when the next one may begin."""
    ticks = draw.randint(12, 18)
    far, lasts = ticks * TICK * SPEED, ACCEPTS_AFTER + ticks * TICK
    steps.append(DriveStep(now, far))
    if kind == "canceled":
        steps.append(DriveStep(now + draw.uniform(0.7, lasts - 0.4), None))
    elif kind == "too late":  # between the success and its result
        steps.append(DriveStep(now + lasts + 0.15, None))
    elif kind == "last moment":  # the server accepts the cancel request, and then succeeds
        steps.append(DriveStep(now + lasts - 0.05, None))
    elif kind == "too early":  # before the server has accepted the goal
        steps.append(DriveStep(now + 0.1, None))
    elif kind == "replaced":
        steps.append(DriveStep(now + draw.uniform(0.6, 0.9), far))
    elif kind == "replaced and stopped":
        newer = now + draw.uniform(0.6, 0.9)
        steps += [DriveStep(newer, far), DriveStep(newer + 0.1, None)]
    elif kind == "replaced at once":
        steps.append(DriveStep(now + 0.1, far))
    if kind in KINDS[RESTART]:
        away = draw.uniform(1.5, 2.0) if kind == "away" else 0.0
        dies.append((now + draw.uniform(0.7, lasts - 0.4), away))
        now += 5.0 + away
        steps.append(DriveStep(now, far))
    return now + lasts + 4.0


class PreemptingServer(PausableNode):
    """Offers /drive_on_heading. A newer goal replaces the older one, which is aborted.

    It accepts a goal after 0.2 s, and sends a result 0.3 s after a success. When a goal is canceled or
    replaced, it sends no zeros. When it dies, nothing is left of it, and a new one knows no earlier goal.
    """

    def __init__(self, plan: DrivePlan) -> None:
        super().__init__("drive_server")
        self.publisher = self.create_publisher(Twist, "/server/cmd_vel", 10)
        self.group = ReentrantCallbackGroup()
        self.life, self.newest = 0, b""
        self.start()
        for stamp, away in plan.dies:
            _once(self, stamp, functools.partial(self.die, away))

    def start(self) -> None:
        """Offer the action."""
        self.server = ActionServer(
            self, DriveOnHeading, ACTION, self.execute, callback_group=self.group,
            goal_callback=self.on_goal, cancel_callback=lambda handle: CancelResponse.ACCEPT,
        )  # fmt: skip

    def die(self, away: Seconds) -> None:
        """Leave everything as it is, and start again after a while."""
        self.life += 1
        self.get_logger().info(DIED)
        self.server.destroy()
        if away:
            _once(self, away, self.start)
        else:
            self.start()

    async def on_goal(self, goal: DriveOnHeading.Goal) -> GoalResponse:
        """Accept a goal, but not at once."""
        await self.pause(ACCEPTS_AFTER)
        return GoalResponse.ACCEPT

    async def execute(self, handle: ServerGoalHandle) -> DriveOnHeading.Result:
        """Bring a goal to its end."""
        life, self.newest = self.life, bytes(handle.goal_id.uuid)
        speed = min(max(handle.request.speed, 0.01), 0.5)
        for tick in range(max(round(handle.request.target.x / speed / TICK), 0)):
            if tick:
                await self.pause(TICK)
            if self.life != life:
                await self.pause(DEAD)
            if self.newest != bytes(handle.goal_id.uuid):
                handle.abort()
                return DriveOnHeading.Result(error_msg="replaced by a newer goal")
            if handle.is_cancel_requested:
                handle.canceled()
                return DriveOnHeading.Result(error_msg="canceled")
            velocity = Twist()
            velocity.linear.x = speed
            self.publisher.publish(velocity)
            handle.publish_feedback(DriveOnHeading.Feedback(distance_traveled=tick * TICK * speed))
        await self.pause(TICK)
        self.publisher.publish(Twist())
        handle.succeed()
        await self.pause(RESULT_AFTER)
        return DriveOnHeading.Result()


class Multiplexer(Node):
    """Forwards the commands of the server and those of its client to the robot, each when it arrives."""

    def __init__(self) -> None:
        super().__init__("multiplexer")
        publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        for topic in ("/server/cmd_vel", COMMANDS):
            self.create_subscription(Twist, topic, publisher.publish, 10)


class User(Node):
    """Publishes distances (m) on /distance, and Empty messages on /stop."""

    def __init__(self, plan: DrivePlan) -> None:
        super().__init__("user")
        self.distances = self.create_publisher(Float64, "/distance", 10)
        self.stops = self.create_publisher(Empty, "/stop", 10)
        for step in plan.steps:
            _once(self, step.stamp, functools.partial(self.send, step.meters))

    def send(self, meters: float | None) -> None:
        """Publish one of them."""
        if meters is None:
            self.stops.publish(Empty())
        else:
            self.distances.publish(Float64(data=meters))


def _once(node: Node, seconds: Seconds, function: Callable[[], Any]) -> None:
    """Call a function after some seconds, and not again."""

    def call() -> None:
        timer.cancel()
        function()

    timer = node.create_timer(seconds, call)


def driving(name: str, seed: int) -> list[Any]:
    """The companions of a scenario: "plain", "crossing", "newer" or "restart"."""
    plan = plan_of(name, seed)
    return [Multiplexer, functools.partial(PreemptingServer, plan), functools.partial(User, plan)]


def trusting_yard() -> World:
    """Return the yard, with a robot that obeys its last command until the next one."""
    return trusting("yard")(0)
