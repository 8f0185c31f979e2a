"""Executors are woken by what concerns them, and only then look for work."""

from collections import Counter

import pytest
import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.service import Service
from std_msgs.msg import Int32

from sim import run
from sim.ros.engine.ready_scan import ReadyScan
from sim.ros.engine.sim_executor import EXECUTOR


@pytest.fixture
def looks(monkeypatch):
    """How often the executor of each node has looked for work, by the node's name."""
    counts = Counter()
    ready = ReadyScan.ready

    def counted(self, nodes=None):
        for node in self.executor._nodes:
            counts[node.get_name()] += 1
        return ready(self, nodes)

    monkeypatch.setattr(ReadyScan, "ready", counted)
    return counts


class Fast(Node):
    def __init__(self):
        super().__init__("fast")
        self.publisher = self.create_publisher(Int32, "count", 10)
        self.create_timer(0.01, lambda: self.publisher.publish(Int32()))


class Slow(Node):
    def __init__(self):
        super().__init__("slow")
        self.create_timer(1.0, lambda: None)


class Listener(Node):
    def __init__(self):
        super().__init__("listener")
        self.received = 0
        self.create_subscription(Int32, "count", self.on_count, 10)

    def on_count(self, message):
        self.received += 1


def test_an_executor_that_nothing_concerns_does_not_look(looks):
    run(Fast, Slow, seconds=5, quiet=True)
    assert looks["fast"] > 1000
    assert looks["slow"] < 20


def test_a_message_wakes_the_executor_of_its_subscription(looks):
    recording = run(Fast, Listener, Slow, seconds=5, quiet=True)
    assert [call.callback for call in recording.callbacks].count("Listener.on_count") == 500
    assert looks["listener"] > 500
    assert looks["slow"] < 20


def test_a_node_that_moves_to_another_executor_takes_its_wakes_along(looks):
    def main():
        rclpy.init()
        listener, first, second = Listener(), SingleThreadedExecutor(), SingleThreadedExecutor()
        first.add_node(listener)
        for _ in range(3):
            first.spin_once(timeout_sec=1.0)
        first.remove_node(listener)
        second.add_node(listener)
        for _ in range(3):
            second.spin_once(timeout_sec=1.0)
        listener.get_logger().info(f"{listener.received}")

    recording = run(Fast, main, seconds=2, quiet=True)
    assert [line.text for line in recording.logs] == ["6"]


class Server(Node):
    def __init__(self):
        super().__init__("server")
        self.create_service(AddTwoInts, "add", lambda request, response: response)


def test_a_service_that_has_not_been_called_is_not_listed():
    listed = []

    class Watched(Server):
        def __init__(self):
            super().__init__()
            self.create_timer(0.1, self.look)

        def look(self):
            entities = [entity for _, entity, _ in EXECUTOR.of(self.executor).scan._entries]
            listed.append([entity.service_name for entity in entities if isinstance(entity, Service)])

    class Client(Node):
        def __init__(self):
            super().__init__("client")
            self.client = self.create_client(AddTwoInts, "add")
            self.create_timer(0.25, lambda: self.client.call_async(AddTwoInts.Request()))

    recording = run(Watched, Client, seconds=0.5, quiet=True)
    assert listed == [[], [], ["/add"], ["/add"], ["/add"]]
    assert len(recording.calls) == 2


class Door:
    """Can be awaited until it is open; nothing announces that."""

    is_open = False

    def __await__(self):
        while not self.is_open:
            yield


def test_a_coroutine_that_nothing_wakes_is_polled_whenever_code_ran():
    door = Door()

    class Waits(Node):
        def __init__(self):
            super().__init__("waits")
            self.timer = self.create_timer(0.1, self.go)

        async def go(self):
            self.timer.cancel()
            await door
            self.get_logger().info("open")

    class Opens(Node):
        def __init__(self):
            super().__init__("opens")
            self.create_timer(0.5, self.open)

        def open(self):
            door.is_open = True

    for programs in ((Waits, Opens), (Opens, Waits)):
        door.is_open = False
        recording = run(*programs, seconds=2, quiet=True)
        assert [(line.stamp, line.text) for line in recording.logs] == [(0.5, "open")]
