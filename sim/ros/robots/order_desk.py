"""A warehouse's orders: they arrive at random, and are served by the true poses of the robots."""

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
SERVING_PERIOD = 0.1  # s
STANDSTILL_SPEED = 0.02  # m/s; a slower robot counts as stopped
FIRST_ORDER_AT = 2.0  # s after the start
OPEN_STATUSES = (Order.WAITING, Order.PICKED_UP)


class OpenOrder(NamedTuple):
    """An open order: the published message, when it ends by itself, and its status then."""

    order: Order
    end: float  # s of the node's clock
    ending: int  # Order.EXPIRED or Order.CANCELED


class OrderDesk(Node):
    """Publishes each order on /orders (warehouse_msgs/Order) whenever its status changes; latched.

    A robot without a load that stops at an order's pickup gets it after the world's `handling` time, the
    oldest order first; it delivers at the desk in the same way. The world's name and the run's seed determine
    the orders and their times. robots: by name, with their true poses.
    """

    def __init__(self, world: World, robots: Mapping[str, MobileRobot], seed: int) -> None:
        super().__init__("order_desk", start_parameter_services=False)
        self.model, self.robots = world.warehouse, robots
        self.rng = Random(f"orders {world.name} {seed}")
        self.open: dict[int, OpenOrder] = {}  # by id, oldest first
        self.load: dict[str, int] = {}  # by robot: the id of the order it carries
        self.since: dict[tuple[str, int], float] = {}  # by robot and order: when the robot stopped there
        self.count, self.next = 0, self.now() + FIRST_ORDER_AT
        self.withdrawals = [self.now() + stamp for stamp in sorted(self.model.withdrawn)]
        self.publisher = self.create_publisher(Order, "/orders", LATCHED)
        self.create_timer(SERVING_PERIOD, self.look)

    def now(self) -> float:
        """The node's time (s)."""
        return self.get_clock().now().nanoseconds / SECOND

    def look(self) -> None:
        """Add new orders, end overdue ones, and serve the robots."""
        now = self.now()
        if now >= self.next:
            self.add_order(now)
        if self.withdrawals and now >= self.withdrawals[0]:
            self.withdraw()
        for number, task in list(self.open.items()):
            if now >= task.end:
                self.change(number, task.ending)
        for name, robot in self.robots.items():
            self.serve(name, robot, now)

    def add_order(self, now: float) -> None:
        """Publish a new order with a random pickup."""
        model, rng = self.model, self.rng
        self.count += 1
        self.next = now + model.interval * (0.5 + rng.random())
        pickup = model.pickups[math.floor(rng.random() * len(model.pickups))]
        canceled, early = rng.random() < model.canceled, rng.random()
        deadline = self.get_clock().now() + Duration(seconds=model.patience)
        order = Order(
            id=self.count,
            pickup=pose_of(pickup),
            delivery=pose_of(model.desk),
            deadline=deadline.to_msg(),
        )
        order.header.frame_id = "map"
        ending = Order.CANCELED if canceled else Order.EXPIRED
        self.open[self.count] = OpenOrder(order, now + model.patience * (early if canceled else 1.0), ending)
        self.change(self.count, Order.WAITING)

    def withdraw(self) -> None:
        """Cancel an order, as the world's `withdrawn` times require."""
        del self.withdrawals[0]
        number = next(iter((*self.load.values(), *self.open)), None)
        if number is not None:
            self.change(number, Order.CANCELED)

    def change(self, number: int, status: int) -> None:
        """Change an order's status, and publish it."""
        order = self.open[number].order
        order.status, order.header.stamp = status, self.get_clock().now().to_msg()
        if status not in OPEN_STATUSES:
            del self.open[number]
            self.load = {name: load for name, load in self.load.items() if load != number}
        self.publisher.publish(order)

    def serve(self, name: str, robot: MobileRobot, now: float) -> None:
        """Hand an order to a robot, or take it, once the robot has stopped there long enough."""
        number = self.order_at(name, robot) if robot.body.velocity.length < STANDSTILL_SPEED else None
        self.since = {key: since for key, since in self.since.items() if key[0] != name or key[1] == number}
        if number is None:
            return
        stopped = now - self.since.setdefault((name, number), now)
        if stopped < self.model.handling - SERVING_PERIOD / 2:
            return
        del self.since[name, number]
        if name in self.load:
            self.change(number, Order.DELIVERED)
        else:
            self.load[name] = number
            self.open[number].order.robot = name
            self.change(number, Order.PICKED_UP)

    def order_at(self, name: str, robot: MobileRobot) -> int | None:
        """The id of the order that can be handled at the robot's position, or None."""
        carried = self.load.get(name)
        if carried is not None:
            return carried if is_near(robot, self.open[carried].order.delivery) else None
        waiting = (task.order for task in self.open.values() if task.order.status == Order.WAITING)
        return next((order.id for order in waiting if is_near(robot, order.pickup)), None)


def is_near(robot: MobileRobot, place: PoseStamped) -> bool:
    """Return whether a robot's center is close enough to be served."""
    position = place.pose.position
    return math.dist(robot.pose[:2], (position.x, position.y)) <= NEAR


def pose_of(place: Pose) -> PoseStamped:
    """A pose message in the map frame."""
    message = PoseStamped()
    message.header.frame_id = "map"
    message.pose.position.x, message.pose.position.y = place[:2]
    message.pose.orientation.z, message.pose.orientation.w = math.sin(place[2] / 2), math.cos(place[2] / 2)
    return message
