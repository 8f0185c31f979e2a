"""In which order stock rclpy takes what is simultaneous: `python -m tests.sim.ros.stock_orders`.

Prints what follows the line of dashes in stock_orders.txt. Publishers and the subscriber are processes of
their own on this machine. It backs the levels of `sim.order`: what has varied here varies at *host*.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Int64

ROUNDS = int(os.environ.get("ORDERS_ROUNDS", "300"))
PERIOD = 0.01  # s
LEAD = 3.0  # s, until all have found each other
DOMAIN = "77"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
NEWCOMERS = 20


def publish(topics: list[str], begin: float) -> None:
    """Publish a number on each of these topics, one after the other, at each period from `begin` on."""
    rclpy.init()
    node = rclpy.create_node(f"publisher_of_{'_'.join(topics)}")
    publishers = [node.create_publisher(Int64, topic, 1000) for topic in topics]
    for number in range(ROUNDS):
        time.sleep(max(0.0, begin + number * PERIOD - time.time()))
        for publisher in publishers:
            publisher.publish(Int64(data=number))
    time.sleep(1.0)


class Taker(Node):
    """Counts how often /b is taken before its /a. work: seconds of other work that keep the executor busy."""

    def __init__(self, order: str, work: float) -> None:
        super().__init__("taker")
        self.taken: dict[str, set[int]] = {"a": set(), "b": set()}
        self.first_b, group = 0, ReentrantCallbackGroup()
        for topic in order:
            callback = self.on_a if topic == "a" else self.on_b
            self.create_subscription(Int64, topic, callback, 1000, callback_group=group)
        if work:
            self.create_timer(2 * work, lambda: time.sleep(work), callback_group=group)

    def on_a(self, message: Int64) -> None:
        self.taken["a"].add(message.data)

    def on_b(self, message: Int64) -> None:
        self.first_b += message.data not in self.taken["a"]
        self.taken["b"].add(message.data)


class Timers(Node):
    """Counts how often the second of two timers of one period comes first."""

    def __init__(self) -> None:
        super().__init__("timers")
        self.first = self.second = self.swapped = 0
        group = ReentrantCallbackGroup()
        self.create_timer(PERIOD, self.on_first, callback_group=group)
        self.create_timer(PERIOD, self.on_second, callback_group=group)

    def on_first(self) -> None:
        self.first += 1

    def on_second(self) -> None:
        self.second += 1
        self.swapped += self.first < self.second


def keep() -> None:
    """Publish once on a latched topic, and then on another forever."""
    rclpy.init()
    node = rclpy.create_node("keeper")
    node.create_publisher(Int64, "kept", LATCHED).publish(Int64())
    publisher = node.create_publisher(Int64, "new", 10)
    node.create_timer(PERIOD, lambda: publisher.publish(Int64()))
    rclpy.spin(node)


class Newcomer(Node):
    """Notes when it first receives on each of two topics, s."""

    def __init__(self) -> None:
        super().__init__("newcomer")
        self.first: dict[str, float] = {}
        self.create_subscription(Int64, "kept", lambda _: self.note("kept"), LATCHED)
        self.create_subscription(Int64, "new", lambda _: self.note("new"), 10)

    def note(self, topic: str) -> None:
        self.first.setdefault(topic, time.monotonic())


def kept() -> str:
    """One row: when a new subscription gets what was kept, beside new messages of the same sender."""
    process = subprocess.Popen([sys.executable, "-m", "tests.sim.ros.stock_orders", "keep"])
    time.sleep(LEAD)
    late = []
    for _ in range(NEWCOMERS):
        node = Newcomer()
        while len(node.first) < 2:
            rclpy.spin_once(node, timeout_sec=0.1)
        late.append(node.first["kept"] - node.first["new"])
        node.destroy_node()
    process.kill()
    second = [1000 * seconds for seconds in late if seconds > 0]
    count = f"the new one first in {len(second)} of {len(late)}, by up to {max(second, default=0):.0f} ms"
    return f"one sends a latched message, then new ones on another topic; subscriptions later: {count}"


def spin(node: Node, parallel: bool, seconds: float) -> None:
    """Spin a node with rclpy's own executor."""
    executor = MultiThreadedExecutor(4) if parallel else SingleThreadedExecutor()
    executor.add_node(node)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        executor.spin_once(timeout_sec=0.1)


def taken(order: str, senders: list[str], parallel: bool = False, work: float = 0.0) -> str:
    """One row: subscriptions made in this order, publishers of these topics."""
    begin = time.time() + LEAD
    command = [sys.executable, "-m", "tests.sim.ros.stock_orders", "publish"]
    processes = [subprocess.Popen([*command, topics, str(begin)]) for topics in senders]
    node = Taker(order, work)
    spin(node, parallel, LEAD + ROUNDS * PERIOD + 0.7)
    for process in processes:
        process.wait()
    node.destroy_node()
    executor = "MultiThreadedExecutor" if parallel else "SingleThreadedExecutor"
    busy = f", {1000 * work:g} ms of other work" if work else ""
    sent = " and ".join(f"one sends /{', then /'.join(topics)}" for topics in senders)
    count = f"/b first in {node.first_b} of {len(node.taken['b'])}"
    return f"{sent}; subscriptions {order}, {executor}{busy}: {count}"


def main() -> None:
    """Print a row for each case."""
    if sys.argv[1:2] == ["publish"]:
        publish(list(sys.argv[2]), float(sys.argv[3]))
        return
    if sys.argv[1:] == ["keep"]:
        keep()
        return
    rclpy.init()
    print(kept(), flush=True)
    for work in (0.0, 0.002):
        for parallel in (False, True):
            for order, senders in (("ab", ["ab"]), ("ba", ["ab"]), ("ab", ["a", "b"])):
                print(taken(order, senders, parallel, work), flush=True)
    for parallel in (False, True):
        node = Timers()
        spin(node, parallel, ROUNDS * PERIOD)
        executor = "MultiThreadedExecutor" if parallel else "SingleThreadedExecutor"
        count = f"the second first in {node.swapped} of {node.second}"
        print(f"two timers of one period, {executor}: {count}", flush=True)


if __name__ == "__main__":
    if "sim" in sys.modules:
        raise SystemExit("rclpy must be its own here, and not as a run replaces it.")
    os.environ["ROS_DOMAIN_ID"] = DOMAIN
    main()
