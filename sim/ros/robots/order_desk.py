"""The orders of a warehouse: they come in as they come, and somebody looks where the robots truly are."""

from __future__ import annotations

import math
from collections.abc import Mapping
from random import Random
from typing import NamedTuple

from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Duration
from warehouse_msgs.msg import Order

from sim.nanoseconds import SECOND
from sim.world import MobileRobot, World
from sim.world.battery import NEAR
from sim.world.robot import Pose

LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
LOOKS = 0.1  # s between two looks at the robots
STANDS = 0.02  # m/s; what is slower stands
FIRST = 2.0  # s until the first order
OPEN = (Order.WAITING, Order.PICKED_UP)


class Task(NamedTuple):
    """An order that is open: what was published, when it ends by itself, and what that is called then."""

    order: Order
    end: float  # s of the node's clock
    ending: int  # Order.EXPIRED or Order.CANCELED


class OrderDesk(Node):
    """Publishes /orders (warehouse_msgs/Order), each again whenever its status changes; kept for latecomers.

    A robot that stands where an order is picked up, and carries nothing, has it after a while (`handling` of
    the world), the oldest one first; so it is handed over at the desk. Which orders come, and when, is
    decided by the world's name and the run's seed. robots: by name, as they truly are.
    """

    def __init__(self, world: World, robots: Mapping[str, MobileRobot], seed: int) -> None:
        super().__init__("order_desk", start_parameter_services=False)
        self.model, self.robots = world.warehouse, robots
        self.chance = Random(f"orders {world.name} {seed}")
        self.open: dict[int, Task] = {}  # by id, oldest first
        self.load: dict[str, int] = {}  # the id of what each robot carries
        self.since: dict[tuple[str, int], float] = {}  # since when a robot stands there for an order
        self.count, self.next = 0, self.now() + FIRST
        self.withdrawals = [self.now() + stamp for stamp in sorted(self.model.withdrawn)]
        self.publisher = self.create_publisher(Order, "/orders", LATCHED)
        self.create_timer(LOOKS, self.look)

    def now(self) -> float:
        """The node's time, s."""
        return self.get_clock().now().nanoseconds / SECOND

    def look(self) -> None:
        """Take in new orders, end those whose time is over, and serve the robots."""
        now = self.now()
        if now >= self.next:
            self.take_in(now)
        if self.withdrawals and now >= self.withdrawals[0]:
            self.withdraw()
        for number, task in list(self.open.items()):
            if now >= task.end:
                self.change(number, task.ending)
        for name, robot in self.robots.items():
            self.serve(name, robot, now)

    def take_in(self, now: float) -> None:
        """A new order, at a place that chance decides."""
        model, chance = self.model, self.chance
        self.count += 1
        self.next = now + model.interval * (0.5 + chance.random())
        place = model.pickups[math.floor(chance.random() * len(model.pickups))]
        canceled, early = chance.random() < model.canceled, chance.random()
        deadline = self.get_clock().now() + Duration(seconds=model.patience)
        order = Order(
            id=self.count,
            pickup=pose_of(place),
            delivery=pose_of(model.desk),
            deadline=deadline.to_msg(),
        )
        order.header.frame_id = "map"
        ending = Order.CANCELED if canceled else Order.EXPIRED
        self.open[self.count] = Task(order, now + model.patience * (early if canceled else 1.0), ending)
        self.change(self.count, Order.WAITING)

    def withdraw(self) -> None:
        """Cancel an order, as the world's model says."""
        del self.withdrawals[0]
        number = next(iter((*self.load.values(), *self.open)), None)
        if number is not None:
            self.change(number, Order.CANCELED)

    def change(self, number: int, status: int) -> None:
        """Give an order another status, and tell."""
        order = self.open[number].order
        order.status, order.header.stamp = status, self.get_clock().now().to_msg()
        if status not in OPEN:
            del self.open[number]
            self.load = {name: load for name, load in self.load.items() if load != number}
        self.publisher.publish(order)

    def serve(self, name: str, robot: MobileRobot, now: float) -> None:
        """Give a robot what it came for, or take it, once it has stood there long enough."""
        number = self.wanted(name, robot) if robot.body.velocity.length < STANDS else None
        self.since = {key: since for key, since in self.since.items() if key[0] != name or key[1] == number}
        if number is None:
            return
        if now - self.since.setdefault((name, number), now) < self.model.handling - LOOKS / 2:
            return
        del self.since[name, number]
        if name in self.load:
            self.change(number, Order.DELIVERED)
        else:
            self.load[name] = number
            self.open[number].order.robot = name
            self.change(number, Order.PICKED_UP)

    def wanted(self, name: str, robot: MobileRobot) -> int | None:
        """The id of the order for which a robot is at the right place, None where there is none."""
        carried = self.load.get(name)
        if carried is not None:
            return carried if is_near(robot, self.open[carried].order.delivery) else None
        waiting = (task.order for task in self.open.values() if task.order.status == Order.WAITING)
        return next((order.id for order in waiting if is_near(robot, order.pickup)), None)


def is_near(robot: MobileRobot, place: PoseStamped) -> bool:
    """Whether a robot's middle is where it can be served."""
    there = place.pose.position
    return math.dist(robot.pose[:2], (there.x, there.y)) <= NEAR


def pose_of(place: Pose) -> PoseStamped:
    """A place in the map frame."""
    message = PoseStamped()
    message.header.frame_id = "map"
    message.pose.position.x, message.pose.position.y = place[:2]
    message.pose.orientation.z, message.pose.orientation.w = math.sin(place[2] / 2), math.cos(place[2] / 2)
    return message
