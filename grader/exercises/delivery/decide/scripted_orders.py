"""An order desk that follows a script, and the decision that is right in each situation of the script."""

import functools
import math
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from rclpy.time import Duration, Time
from sensor_msgs.msg import BatteryState
from warehouse_msgs.msg import Order

from grader.companions.map_messages import LATCHED, pose_stamped
from grader.geometry import Point
from sim.evidence import Seconds, since_start

LEAST, PER_METER = 20.0, 4.0  # s, and s for each meter from pickup to delivery: what an order takes
AMPLE = 200.0  # s
WELL = 0.9  # how full the battery is where that isn't tried
SPELL = 2.2, 2.8  # s; how long a situation lasts


@dataclass(frozen=True)
class ScriptedOrder:
    """An order: from where to where, and how many seconds it has left when it comes."""

    id: int
    pickup: Point
    delivery: Point
    left: Seconds

    @property
    def takes(self) -> Seconds:
        """Return how long an order takes, by the rule of the task."""
        return LEAST + PER_METER * math.dist(self.pickup, self.delivery)


@dataclass
class Situation:
    """A message at `begin`, and what is right until `end`: a state, and the place to go to.

    about: the rule that is tested. reason: what happened, in words. orders: each with its new status.
    """

    about: str
    reason: str
    begin: Seconds
    end: Seconds
    state: str
    place: Point
    share: float
    orders: list[tuple[ScriptedOrder, int]]


class Script:
    """The situations of a seed, one after the other. dock: where the charger is."""

    def __init__(self, seed: int) -> None:
        self.draw = random.Random(f"decide {seed}")
        self.dock = self._point(0.0)
        self.situations: list[Situation] = []
        self.begin, self.count = 0.0, 0
        self._shift()
        parts = [self._too_late, self._in_between, self._three_at_once]
        self.draw.shuffle(parts)
        for part in parts:
            part()

    def _point(self, left: float) -> Point:
        return round(self.draw.uniform(left, left + 2.0), 2), round(self.draw.uniform(0.0, 9.0), 2)

    def _job(self, left: Seconds = AMPLE, way: float = 5.0) -> ScriptedOrder:
        """An order with so many seconds left; way: from pickup to delivery, m."""
        self.count += 1
        pickup, angle = self._point(4.0), self.draw.uniform(-1.0, 1.0)
        delivery = pickup[0] - way * math.cos(angle), pickup[1] + way * math.sin(angle)
        return ScriptedOrder(self.count, pickup, (round(delivery[0], 2), round(delivery[1], 2)), left)

    def _add(self, about: str, reason: str, state: str, place: Point,
             *orders: tuple[ScriptedOrder, int], **more: float) -> None:
        end = self.begin + more.get("lasts", self.draw.uniform(*SPELL))
        share = more.get("share", WELL)
        situation = Situation(about, reason, self.begin, end, state, place, round(share, 2), list(orders))
        self.situations.append(situation)
        self.begin = end

    def _shift(self) -> None:
        """From what was published before any subscription existed to a charged battery."""
        first, gone, urgent = self._job(), self._job(AMPLE - 60.0), self._job(AMPLE - 80.0)
        before = (first, Order.WAITING), (gone, Order.WAITING), (gone, Order.CANCELED)
        low, half, full = (self.draw.uniform(*part) for part in ((0.1, 0.25), (0.4, 0.7), (0.83, 0.95)))
        reason = "this order was published before your node started, along with one that was canceled"
        self._add("past", reason, "fetch", first.pickup, *before)
        reason = "a more urgent order arrived while it was fetching this one"
        self._add("keeps", reason, "fetch", first.pickup, (urgent, Order.WAITING))
        reason = f"it is carrying order {first.id}, and the battery is at {low:.0%}"
        self._add("delivers", reason, "deliver", first.delivery, (first, Order.PICKED_UP), share=low)
        reason = f"the load is delivered, and the battery is at {low:.0%}"
        self._add("charges", reason, "charge", self.dock, (first, Order.DELIVERED), share=low)
        self._add("charges", f"it is charging, and is at {half:.0%}", "charge", self.dock, share=half)
        reason = f"it has been charging, and is at {full:.0%}"
        self._add("charges", reason, "fetch", urgent.pickup, share=full)
        reason = "the only order was canceled"
        self._add("gives up", reason, "rest", self.dock, (urgent, Order.CANCELED))

    def _too_late(self) -> None:
        """One that can't be made, and one that can be, for a while."""
        far = self._job(0.0, self.draw.uniform(7.0, 9.0))
        far = ScriptedOrder(far.id, far.pickup, far.delivery, far.takes - 3.0)
        near = self._job(0.0, self.draw.uniform(1.0, 2.0))
        near = ScriptedOrder(near.id, near.pickup, near.delivery, near.takes + 3.0)
        reason = f"the only order takes {far.takes:.3g} s and has {far.left:.3g} s left"
        self._add("gives up", reason, "rest", self.dock, (far, Order.WAITING))
        reason = f"an order takes {near.takes:.3g} s and has {near.left:.3g} s left"
        self._add("gives up", reason, "fetch", near.pickup, (near, Order.WAITING), lasts=3.0)
        reason = f"the order that it was fetching takes {near.takes:.3g} s, and has less left by now"
        self._add("gives up", reason, "rest", self.dock)

    def _in_between(self) -> None:
        """A battery that is neither low nor full is no reason to charge."""
        job, share = self._job(), self.draw.uniform(0.38, 0.5)
        reason = f"it isn't charging, the battery is at {share:.0%}, and an order arrives"
        self._add("charges", reason, "fetch", job.pickup, (job, Order.WAITING), share=share)
        reason = "the only order expired"
        self._add("gives up", reason, "rest", self.dock, (job, Order.EXPIRED))

    def _three_at_once(self) -> None:
        """The most urgent one first; and another one is picked up on the way."""
        jobs = [self._job(AMPLE - 30.0 * number) for number in range(3)]
        urgent, other = jobs[2], jobs[0]
        self.draw.shuffle(jobs)
        jobs.remove(urgent)
        jobs.insert(1, urgent)  # who takes the first to come, or the last, is wrong in each run
        reason = "three orders arrived at once, and this one is the most urgent"
        self._add("keeps", reason, "fetch", urgent.pickup, *((job, Order.WAITING) for job in jobs))
        reason = f"it picked up order {other.id} on its way"
        self._add("delivers", reason, "deliver", other.delivery, (other, Order.PICKED_UP))
        over = [(job, Order.DELIVERED if job is other else Order.CANCELED) for job in jobs]
        self._add("gives up", "all orders are delivered or canceled", "rest", self.dock, *over)


class Desk(Node):
    """Publishes on /orders, /battery_state and /dock_pose what the script of a seed has.

    What is latched and belongs to the first situation is published before the student's node is there.
    """

    def __init__(self, seed: int) -> None:
        super().__init__("desk")
        self.script = Script(seed)
        self.ahead = list(self.script.situations)
        self.deadlines: dict[int, Time] = {}
        self.share = WELL
        self.orders = self.create_publisher(Order, "/orders", LATCHED)
        self.battery = self.create_publisher(BatteryState, "/battery_state", 10)
        self.docks = self.create_publisher(PoseStamped, "/dock_pose", LATCHED)
        self.docks.publish(pose_stamped(self.get_clock().now().to_msg(), *self.script.dock))
        self.publish_due()
        self.create_timer(0.1, self.publish_due)
        self.create_timer(0.25, self.publish_battery)

    def publish_due(self) -> None:
        """Publish what is due by now."""
        now = since_start(self.get_clock().now().to_msg())
        while self.ahead and self.ahead[0].begin <= now + 1e-6:
            situation = self.ahead.pop(0)
            self.share = situation.share
            self.publish_battery()
            for job, status in situation.orders:
                self.orders.publish(self.order(job, status))

    def order(self, job: ScriptedOrder, status: int) -> Order:
        """Return the message on an order that has this status now."""
        now = self.get_clock().now()
        end = self.deadlines.setdefault(job.id, now + Duration(seconds=job.left))
        stamp = now.to_msg()
        places = {"pickup": pose_stamped(stamp, *job.pickup), "delivery": pose_stamped(stamp, *job.delivery)}
        robot = "robot" if status in (Order.PICKED_UP, Order.DELIVERED) else ""
        order = Order(id=job.id, status=status, robot=robot, deadline=end.to_msg(), **places)
        order.header.stamp, order.header.frame_id = stamp, "map"
        return order

    def publish_battery(self) -> None:
        """Publish how full the battery is."""
        message = BatteryState(percentage=self.share)
        message.header.stamp = self.get_clock().now().to_msg()
        self.battery.publish(message)


def desk(seed: int) -> list[Callable[[], Node]]:
    """Return the desk of a seed, as companions of a run."""
    return [functools.partial(Desk, seed)]


def situations(seed: int, about: str) -> Iterator[Situation]:
    """Return the situations of a seed that test this rule."""
    return (one for one in Script(seed).situations if one.about == about)
