"""Decision: which order next, when to charge, when to give up?"""

import math

from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import BatteryState
from std_msgs.msg import String
from warehouse_msgs.msg import Order

from tests.bench.delivery.floor import KEPT


class Decision(Node):
    """Chooses what to do next, twice a second: deliver, charge, fetch, or rest at the charger.

    Publishes /goal_pose whenever there is another place to go to, and /state for people.
    """

    low, enough, least = 0.35, 0.9, 40.0  # shares of the battery; s that an order must still have

    def __init__(self):
        super().__init__("decision")
        self.orders, self.pose, self.dock, self.share = {}, None, None, 1.0
        self.state, self.goal = "", None
        self.create_subscription(Order, "/orders", self.on_order, KEPT)
        self.create_subscription(BatteryState, "/battery_state", self.on_battery, 10)
        self.create_subscription(PoseStamped, "/dock_pose", self.on_dock, KEPT)
        self.create_subscription(PoseStamped, "/robot_pose", self.on_pose, 10)
        self.goal_pub = self.create_publisher(PoseStamped, "/goal_pose", 10)
        self.state_pub = self.create_publisher(String, "/state", 10)
        self.create_timer(0.5, self.decide)

    def on_order(self, order):
        self.orders[order.id] = order

    def on_battery(self, battery):
        self.share = battery.percentage

    def on_dock(self, dock):
        self.dock = dock

    def on_pose(self, pose):
        self.pose = pose

    def decide(self):
        if self.pose is None or self.dock is None:
            return
        state, goal = self.choose()
        if (state, goal) != (self.state, self.goal):
            self.get_logger().info(state)
        self.state, self.goal = state, goal
        self.goal_pub.publish(goal)
        self.state_pub.publish(String(data=state))

    def choose(self):
        """The state and where to go in it."""
        carried = [order for order in self.orders.values() if order.status == Order.PICKED_UP]
        if carried:
            return f"deliver {carried[0].id}", carried[0].delivery
        if self.share < self.low or (self.state == "charge" and self.share < self.enough):
            return "charge", self.dock
        waiting = [order for order in self.orders.values() if self.is_worth_it(order)]
        if not waiting:
            return "rest", self.dock
        order = min(waiting, key=lambda order: (self.way(order.pickup), order.id))
        return f"fetch {order.id}", order.pickup

    def is_worth_it(self, order):
        left = (Time.from_msg(order.deadline) - self.get_clock().now()).nanoseconds / 1e9
        return order.status == Order.WAITING and left > self.least

    def way(self, place):
        here, there = self.pose.pose.position, place.pose.position
        return math.dist((here.x, here.y), (there.x, there.y))
