"""Decisions of a delivery robot: right ones, and wrong ones named by their defect."""

import math
import time

import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from sensor_msgs.msg import BatteryState
from std_msgs.msg import String
from warehouse_msgs.msg import Order

from grader.exercises.delivery import LATCHED, pose_2d, seconds


class Decision(Node):
    """As one would write it; the wrong ones change one thing each."""

    low, enough, period = 0.3, 0.8, 0.5
    profile = order_profile = LATCHED

    def __init__(self):
        super().__init__("decision")
        self.orders, self.share, self.dock, self.state, self.begun = {}, 1.0, None, "rest", None
        self.create_subscription(Order, "/orders", self.on_order, self.order_profile)
        self.create_subscription(BatteryState, "/battery_state", self.on_battery, 10)
        self.create_subscription(PoseStamped, "/dock_pose", self.on_dock, self.profile)
        self.goal_pub = self.create_publisher(PoseStamped, "/goal_pose", 10)
        self.state_pub = self.create_publisher(String, "/state", 10)
        self.create_timer(self.period, self.decide)

    def on_order(self, order):
        self.orders[order.id] = order

    def on_battery(self, battery):
        self.share = battery.percentage

    def on_dock(self, dock):
        self.dock = dock

    def now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def takes(self, order):
        return 20.0 + 4.0 * math.dist(pose_2d(order.pickup.pose)[:2], pose_2d(order.delivery.pose)[:2])

    def can_be_made(self, order):
        left = seconds(order.deadline) - self.now()
        return order.status == Order.WAITING and left >= self.takes(order)

    def choose(self):
        for order in self.orders.values():
            if order.status == Order.PICKED_UP:
                return "deliver", order
        if self.share < self.low or (self.state == "charge" and self.share < self.enough):
            return "charge", None
        return self.fetch()

    def fetch(self):
        good = [order for order in self.orders.values() if self.can_be_made(order)]
        if not good:
            return "rest", None
        return "fetch", min(good, key=self.rank)

    def rank(self, order):
        return order.id != self.begun, seconds(order.deadline)

    def decide(self):
        if self.dock is None:
            return
        self.state, order = self.choose()
        self.begun = order.id if self.state == "fetch" else None
        places = {"fetch": order and order.pickup, "deliver": order and order.delivery}
        self.say(places.get(self.state, self.dock))

    def say(self, place):
        self.goal_pub.publish(place)
        self.state_pub.publish(String(data=self.state))


class ForgetsWhatIsOver(Decision):
    """Keeps open orders only, and chooses among sorted ones."""

    def on_order(self, order):
        if order.status in (Order.WAITING, Order.PICKED_UP):
            self.orders[order.id] = order
        else:
            self.orders.pop(order.id, None)

    def fetch(self):
        good = sorted(filter(self.can_be_made, self.orders.values()), key=lambda one: seconds(one.deadline))
        kept = [order for order in good if order.id == self.begun]
        return ("fetch", (kept or good)[0]) if good else ("rest", None)


class OneClassForEachState(Node):
    """A design of its own: states are classes; it looks four times a second."""

    def __init__(self):
        super().__init__("chief")
        kept = QoSProfile(depth=50, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.known, self.battery, self.home = {}, 1.0, None
        self.charging, self.target, self.ticks = False, None, 0
        self.goals = self.create_publisher(PoseStamped, "goal_pose", 1)
        self.words = self.create_publisher(String, "state", 1)
        self.create_subscription(Order, "orders", lambda msg: self.known.update({msg.id: msg}), kept)
        self.create_subscription(BatteryState, "battery_state", self.fill, 1)
        self.create_subscription(PoseStamped, "dock_pose", lambda msg: setattr(self, "home", msg), kept)
        self.create_timer(0.25, self.tick)

    def fill(self, msg):
        self.battery = msg.percentage

    def left(self, order):
        a, b = order.pickup.pose.position, order.delivery.pose.position
        end = Time.from_msg(order.deadline) - self.get_clock().now()
        return end.nanoseconds / 1e9 - 20 - 4 * math.hypot(a.x - b.x, a.y - b.y)

    def tick(self):
        self.ticks += 1
        if self.home is None or self.ticks % 2:
            return
        word, place = self.next()
        self.goals.publish(place)
        self.words.publish(String(data=word))

    def next(self):
        carried = [one for one in self.known.values() if one.status == Order.PICKED_UP]
        if carried:
            self.charging, self.target = False, None
            return "deliver", carried[0].delivery
        self.charging = self.battery < (0.8 if self.charging else 0.3)
        if self.charging:
            self.target = None
            return "charge", self.home
        waiting = [one for one in self.known.values() if one.status == Order.WAITING and self.left(one) > 0]
        waiting.sort(key=lambda one: (one.deadline.sec, one.deadline.nanosec))
        if self.target not in [one.id for one in waiting]:
            self.target = waiting[0].id if waiting else None
        if self.target is None:
            return "rest", self.home
        return "fetch", self.known[self.target].pickup


class TakesTheFirstToCome(OneClassForEachState):
    """Of the orders that wait, the one that came first, whatever its deadline."""

    def next(self):
        orders = self.known.values()
        waiting = [one.id for one in orders if one.status == Order.WAITING and self.left(one) > 0]
        if waiting and self.target not in waiting:
            self.target = waiting[0]
        return super().next()


class ReceivesTheNewOnly(Decision):
    """Subscribes as to any other topic."""

    profile = order_profile = 10


class ReceivesNewOrdersOnly(Decision):
    """It knows the dock, and no order from before."""

    order_profile = 10


class NeverForgets(Decision):
    """Each message is one more order."""

    def on_order(self, order):
        self.orders[len(self.orders)] = order


class FirstWordCounts(Decision):
    """A known id isn't looked at again."""

    def on_order(self, order):
        self.orders.setdefault(order.id, order)


class ChargesFirst(Decision):
    """The battery before the load."""

    def choose(self):
        if self.share < self.low or (self.state == "charge" and self.share < self.enough):
            return "charge", None
        return super().choose()


class OneLimit(Decision):
    """Leaves the charger as soon as it has 30 %."""

    enough = 0.3


class ChargesBelow80(Decision):
    """The other limit alone."""

    low = 0.8


class FetchesWhatIsTooLate(Decision):
    """Every order that waits is taken."""

    def can_be_made(self, order):
        return order.status == Order.WAITING


class AsksOnlyOnce(Decision):
    """Whether an order can be made is asked when it begins, and never again."""

    def can_be_made(self, order):
        return super().can_be_made(order) or (order.id == self.begun and order.status == Order.WAITING)


class Dithers(Decision):
    """Always the most urgent one: as in the lesson."""

    def rank(self, order):
        return seconds(order.deadline)


class StaysWithCanceled(Decision):
    """What it began is fetched, whatever has become of it."""

    def can_be_made(self, order):
        return order.id == self.begun or super().can_be_made(order)


class OnceASecond(Decision):
    """Half as often."""

    period = 1.0


class Waits(Decision):
    """Waits until the robot might be there."""

    def say(self, place):
        super().say(place)
        time.sleep(4.0)


class SomeFrame(Decision):
    """Makes a pose of its own, with the place and without the frame."""

    def say(self, place):
        super().say(PoseStamped(pose=place.pose))


def main():
    rclpy.init()
    rclpy.spin(Decision())


class KeepsOneOrder(Decision):
    """Several orders were published before it began, and its queue holds one of them."""

    order_profile = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
